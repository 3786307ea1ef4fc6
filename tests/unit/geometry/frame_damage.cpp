// Frames with very small cells, and damaged ones: rejected with one line and without much memory.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "geometry/vdb/openvdb_adapter.h"
#include "unit/geometry/mesh_files.h"

namespace frame_damage_tests {
using namespace seiche;
using mesh_files::TemporaryFolder;

namespace {

// A ball with a radius of a quarter of the domain, 16 cells across.
vdb::Frame ball(double cell_size) {
  vdb::Frame frame;
  frame.cell_size = cell_size;
  frame.lower = cell_size * Vec3(3, -5, 0.25);
  frame.creator = "unit test";
  vdb::Grid grid{"surface", vdb::GridKind::level_set, float(3 * cell_size), {}};
  vdb::Block block{{0, 0, 0}, {16, 16, 16}, {}};
  for (int n = 0; n < 4096; ++n) {
    const Vec3 x = Vec3(n % 16, n / 16 % 16, n / 256) - Vec3::Constant(7.5);
    block.values.push_back(float(std::clamp(x.norm() - 4, -3.0, 3.0) * cell_size));
  }
  grid.blocks.push_back(block);
  frame.grids.push_back(grid);
  return frame;
}

// Error message for a frame; empty if it is read.
std::string refusal(const TemporaryFolder& folder, const std::string& bytes) {
  try {
    vdb::decode(folder.write("frame.vdb", bytes));
    return "";
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
}

}  // namespace

TEST_CASE("frames hold cells of any size") {
  const TemporaryFolder folder;
  for (const double h : {1e-13, 1e-6, 1.0, 1e4}) {
    const vdb::Frame written = ball(h), read = vdb::decode(folder.write("frame.vdb", vdb::encode(written)));
    CAPTURE(h);
    CHECK(read.cell_size == h);
    CHECK(read.lower == written.lower);
    CHECK(read.grids.at(0).blocks.at(0).values == written.grids[0].blocks[0].values);
    const auto distance = vdb::read_distance(folder / "frame.vdb");
    // Mean of eight voxels, half a cell off along each axis: 5 - 4 plus (0.5^2 + 0.5^2)/(2 * 5).
    CHECK((*distance)(written.lower + h * Vec3(13, 8, 8)) == Approx(1.05 * h).epsilon(1e-3));
  }
}

TEST_CASE("frames cut off anywhere are refused in a line") {
  const TemporaryFolder folder;
  const std::string whole = vdb::encode(ball(0.1));
  for (std::size_t size = 1; size < whole.size(); size += size < 1500 ? 1 : 97) {
    const std::string text = refusal(folder, whole.substr(0, size));
    CAPTURE(size, text);
    CHECK((!text.empty() && text.size() < 1000));
  }
}

// OpenVDB reads packed blocks of any length over a buffer's end, so bytes that no checksum covers never reach it.
TEST_CASE("a frame with a bit changed anywhere, and one with bytes after its checksum, are refused in a line") {
  const TemporaryFolder folder;
  const std::string whole = vdb::encode(ball(0.1));
  for (std::size_t bit = 0; bit < 8 * whole.size(); bit += bit < 8 * 1500 ? 11 : 503) {
    std::string bytes = whole;
    bytes[bit / 8] = char(bytes[bit / 8] ^ (1 << bit % 8));
    for (const std::string& tail : {std::string(), std::string("appended")}) {
      const std::string text = refusal(folder, bytes + tail);
      CAPTURE(bit, tail, text);
      CHECK((!text.empty() && text.size() < 1000));
    }
  }
  CHECK_FALSE(refusal(folder, whole + "appended").empty());
}

}  // namespace frame_damage_tests
