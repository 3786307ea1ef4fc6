// Frames are read back voxel by voxel by Seiche and by other programs; corrupt ones are rejected.
#include <catch2/catch.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/shape_spec.h"
#include "geometry/shapes/shapes.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "unit/files/scratch.h"

namespace vdb_tests {
using namespace seiche;

namespace {

// One dense block of a function of the cell centre, with `width` values per voxel.
template <class Function>
vdb::Block sample(const vdb::Frame& frame, const std::array<int, 3>& lower, const std::array<int, 3>& upper,
                  Function&& values) {
  vdb::Block block{lower, upper, {}};
  for (int k = lower[2]; k < upper[2]; ++k) {
    for (int j = lower[1]; j < upper[1]; ++j) {
      for (int i = lower[0]; i < upper[0]; ++i) {
        for (const double v : values(Vec3(frame.lower + frame.cell_size * (Vec3(i, j, k) + Vec3::Constant(0.5))))) {
          block.values.push_back(float(v));
        }
      }
    }
  }
  return block;
}

vdb::Frame empty_frame(int dimension) {
  vdb::Frame frame;
  frame.dimension = dimension;
  frame.lower = Vec3(-0.25, 0.5, dimension == 3 ? 0.125 : 0.0);
  frame.cell_size = 0.03125;
  frame.time = 1.0 / 3;
  frame.dt = 0.01;
  frame.number = 8;
  frame.creator = "unit test";
  return frame;
}

const std::array<int, 3> extent3{33, 29, 21}, extent2{33, 29, 1};

// A ball with a rotating velocity inside and zero outside, and a linear scalar; in two blocks.
vdb::Frame ball_frame(int dimension) {
  vdb::Frame frame = empty_frame(dimension);
  const std::array<int, 3> all = dimension == 3 ? extent3 : extent2;
  std::array<int, 3> part = all, rest{0, 0, 0};
  part[0] = rest[0] = 13;
  const Vec3 center = frame.lower + frame.cell_size * Vec3(16.2, 14.1, dimension == 3 ? 10.3 : 0.5);
  const auto phi = [=](const Vec3& x) { return std::array{(x - center).norm() - 0.25}; };
  const auto turning = [=](const Vec3& x) {
    const bool inside = phi(x)[0] < 0;
    return std::array{inside ? center[1] - x[1] : 0, inside ? x[0] - center[0] : 0, 0.0};
  };
  const auto linear = [](const Vec3& x) { return std::array{1 + x[0] - 2 * x[1]}; };
  const float band = float(3 * frame.cell_size);
  const auto two = [&](const auto& f) {
    return std::vector{sample(frame, rest, all, f), sample(frame, {0, 0, 0}, part, f)};
  };
  frame.grids.push_back({"surface", vdb::GridKind::level_set, band, two(phi)});
  frame.grids.push_back({"vel", vdb::GridKind::staggered_vector, 0, two(turning)});
  frame.grids.push_back({"pressure", vdb::GridKind::scalar, 0, two(linear)});
  return frame;
}

float expected_value(const vdb::Grid& grid, float v) {
  return grid.kind == vdb::GridKind::level_set ? std::clamp(v, -grid.background, grid.background) : v;
}

void require_equal_voxels(const vdb::Grid& written, const vdb::Grid& read) {
  const vdb::Block& dense = read.blocks.at(0);
  const int width = written.kind == vdb::GridKind::staggered_vector ? 3 : 1;
  std::size_t wrong = 0;
  for (const vdb::Block& block : written.blocks) {
    const float* v = block.values.data();
    for (int k = block.lower[2]; k < block.upper[2]; ++k) {
      for (int j = block.lower[1]; j < block.upper[1]; ++j) {
        for (int i = block.lower[0]; i < block.upper[0]; ++i) {
          const std::size_t at = i + dense.upper[0] * (std::size_t(j) + std::size_t(dense.upper[1]) * k);
          for (int c = 0; c < width; ++c) wrong += dense.values[at * width + c] != expected_value(written, *v++);
        }
      }
    }
  }
  CHECK(wrong == 0);
}

// OpenVDB sorts the grids of a file by name, not by the order of writing.
const vdb::Grid& find(const vdb::Frame& frame, const std::string& name) {
  const auto named = [&](const vdb::Grid& grid) { return grid.name == name; };
  const auto found = std::find_if(frame.grids.begin(), frame.grids.end(), named);
  REQUIRE(found != frame.grids.end());
  return *found;
}

int run(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str());
}

bool installed(const std::string& test) {
  return run(test) == 0;
}

std::string refusal(const std::filesystem::path& file) {
  try {
    vdb::decode(file);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  return "";
}

// A half-full tank with a level surface that touches all walls.
vdb::Frame tank_frame() {
  vdb::Frame frame = empty_frame(3);
  const double level = frame.lower[1] + 0.4;
  const auto phi = [=](const Vec3& x) { return std::array{x[1] - level}; };
  frame.grids.push_back(
      {"surface", vdb::GridKind::level_set, float(3 * frame.cell_size), {sample(frame, {0, 0, 0}, extent3, phi)}});
  return frame;
}

}  // namespace

TEST_CASE("a frame read back has the same drops, by id") {
  const ScratchFolder folder;
  const int dimension = GENERATE(2, 3);
  vdb::Frame frame = ball_frame(dimension);
  const double h = frame.cell_size, z = frame.lower[2] + (dimension == 2 ? 0.5 : 1.3) * h;
  for (int n = 0; n < 5; ++n)
    frame.points.push_back({{frame.lower[0] + (0.01 + 1.7 * n) * h, frame.lower[1] + 2.99 * h, z},
                            {1.0 * n, -2, 0.5},
                            0.1 * h * (1 + n),
                            std::int64_t(1) << (40 + n)});
  const vdb::Frame read = vdb::decode(folder.write("frame.0008.vdb", vdb::encode(frame)));
  CHECK(read.grids.size() == 3);
  REQUIRE(read.points.size() == 5);
  for (std::size_t n = 0; n < 5; ++n) {
    CHECK((read.points[n].place - frame.points[n].place).norm() < 1e-6 * h);
    CHECK(read.points[n].velocity == frame.points[n].velocity);
    CHECK(read.points[n].radius == Approx(frame.points[n].radius));
    CHECK(read.points[n].id == frame.points[n].id);
  }
}

TEST_CASE("a frame read back has the same voxels and metadata") {
  const ScratchFolder folder;
  const int dimension = GENERATE(2, 3);
  const vdb::Frame frame = ball_frame(dimension);
  const vdb::Frame read = vdb::decode(folder.write("frame.0008.vdb", vdb::encode(frame)));
  CHECK(read.dimension == dimension);
  CHECK(read.time == frame.time);
  CHECK(read.dt == frame.dt);
  CHECK(read.number == 8);
  CHECK(read.creator == "unit test");
  CHECK(read.cell_size == frame.cell_size);
  CHECK(read.lower == frame.lower);
  REQUIRE(read.grids.size() == 3);
  for (std::size_t g = 0; g < 3; ++g) {
    const vdb::Grid& grid = find(read, frame.grids[g].name);
    CHECK(grid.kind == frame.grids[g].kind);
    CHECK(grid.background == frame.grids[g].background);
    CHECK(grid.blocks.at(0).upper == (dimension == 3 ? extent3 : extent2));
    require_equal_voxels(frame.grids[g], grid);
  }
}

TEST_CASE("the velocity may have another name in the file; both are read alike") {
  const ScratchFolder folder;
  const vdb::Frame frame = ball_frame(3);
  const std::string bytes = vdb::encode(frame, "velocity");
  CHECK(bytes.size() < vdb::encode(frame).size() + 100);  // written once
  const vdb::Frame read = vdb::decode(folder.write("named.vdb", bytes));
  require_equal_voxels(find(frame, "vel"), find(read, "vel"));
  if (installed("command -v vdb_print"))
    CHECK(run("vdb_print " + (folder / "named.vdb").string() + " | grep -qw velocity") == 0);
}

TEST_CASE("a frame without any liquid and one of nothing but liquid are read back") {
  const ScratchFolder folder;
  const double sign = GENERATE(-1.0, 1.0);
  vdb::Frame frame = empty_frame(3);
  frame.grids.push_back({"surface",
                         vdb::GridKind::level_set,
                         0.1f,
                         {sample(frame, {0, 0, 0}, extent3, [=](const Vec3&) { return std::array{sign}; })}});
  const vdb::Frame read = vdb::decode(folder.write("frame.vdb", vdb::encode(frame)));
  require_equal_voxels(frame.grids[0], read.grids.at(0));
}

TEST_CASE("liquid against the walls keeps its sign in the whole domain") {
  const ScratchFolder folder;
  const vdb::Frame frame = tank_frame();
  const vdb::Frame read = vdb::decode(folder.write("tank.vdb", vdb::encode(frame)));
  require_equal_voxels(frame.grids[0], read.grids.at(0));
}

TEST_CASE("frames open in programs that share no code with Seiche") {
  const ScratchFolder folder;
  const auto ball = folder.write("ball.vdb", vdb::encode(ball_frame(3)));
  const auto disc = folder.write("disc.vdb", vdb::encode(ball_frame(2)));
  const auto tank = folder.write("tank.vdb", vdb::encode(tank_frame()));
  const std::string files = ball.string() + " " + disc.string() + " " + tank.string();
  if (installed("command -v vdb_print")) CHECK(run("vdb_print -l " + files) == 0);
  if (installed("command -v vdb_render")) {
    const auto picture = folder / "ball.ppm";
    CHECK(run("vdb_render " + ball.string() + " " + picture.string() + " -res 64x64 -translate 0,1,3") == 0);
    CHECK(std::filesystem::file_size(picture) > 0);
  }
  if (installed("/usr/bin/python3 -c 'import pyopenvdb'")) {
    const auto tests = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path();
    const std::string script = (tests / "faults" / "read_frames.py").string() + " ";
    CHECK(run("/usr/bin/python3 " + script + files) == 0);
    CHECK(run("/usr/bin/python3 " + script + folder.path().string() + "/none.vdb") != 0);
  }
}

TEST_CASE("a value that is not finite is not written") {
  vdb::Frame frame = ball_frame(3);
  frame.grids[1].blocks[1].values[3 * (5 + 13 * (2 + 29 * 4)) + 1] = std::numeric_limits<float>::quiet_NaN();
  CHECK_THROWS_WITH(vdb::encode(frame), Catch::Contains("vel") && Catch::Contains("(5, 2, 4)"));
}

TEST_CASE("files that are no frames are refused with their name") {
  const ScratchFolder folder;
  CHECK_THAT(refusal(folder / "none.vdb"), Catch::Contains("none.vdb") && Catch::Contains("No such file"));
  CHECK_THAT(refusal(folder.path()), Catch::Contains("folder"));
  CHECK_THAT(refusal(folder.write("empty.vdb", "")), Catch::Contains("0 bytes"));
  CHECK_THAT(refusal(folder.write("text.vdb", "not a frame at all\n")), Catch::Contains("text.vdb"));
  const std::string bytes = vdb::encode(ball_frame(3));
  for (const double share : {0.01, 0.1, 0.3, 0.5, 0.9, 0.99}) {
    const auto file = folder.write("cut.vdb", bytes.substr(0, std::size_t(share * double(bytes.size()))));
    CHECK_THAT(refusal(file), Catch::Contains("cut.vdb"));
  }
}

TEST_CASE("the level set of a frame serves as a shape") {
  const ScratchFolder folder;
  const int dimension = GENERATE(2, 3);
  const vdb::Frame frame = ball_frame(dimension);
  ShapeSpec spec;
  spec.kind = "level_set";
  spec.file = folder.write("ball.vdb", vdb::encode(frame));
  spec.transform.translate = Vec3(0.5, -0.25, 0);
  const double h = frame.cell_size;
  const Vec3 center = frame.lower + h * Vec3(16.2, 14.1, dimension == 3 ? 10.3 : 0.5) + spec.transform.translate;
  const auto distance = [&](const Vec3& x) {
    if (dimension == 2) return (*make_shape<2>(spec, {h, nullptr}))(truncate<2>(x));
    return (*make_shape<3>(spec, {h, nullptr}))(x);
  };
  // Trilinear interpolation of a distance with curvature 1/r has an error of at most 3 h^2 / (8 r) = 1.5e-3 at r =
  // 0.25.
  for (const double r : {0.2, 0.25, 0.3}) {
    CHECK(distance(Vec3(center + r * Vec3(0.6, 0.8, 0))) == Approx(r - 0.25).margin(1.5e-3));
  }
  CHECK(distance(center) == Approx(-3 * h).epsilon(1e-6));  // the end of the band, in float
  CHECK(distance(Vec3(center + Vec3(20, 0, 0))) > 15);      // far outside: distance to the domain
}

TEST_CASE("a frame of the other dimension is no shape of the scene") {
  const ScratchFolder folder;
  ShapeSpec spec;
  spec.kind = "level_set";
  spec.where = "scene.toml:7";
  spec.file = folder.write("disc.vdb", vdb::encode(ball_frame(2)));
  CHECK_THROWS_WITH(make_shape<3>(spec, {0.1, nullptr}),
                    Catch::StartsWith("scene.toml:7: ") && Catch::Contains("2 dimensions"));
}

}  // namespace vdb_tests
