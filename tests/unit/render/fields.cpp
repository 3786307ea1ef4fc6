// Quantities derived from the velocity, ranges of colours, streamlines, foam.
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "base/fluid_spec.h"
#include "base/solid_spec.h"
#include "files/checked_file.h"
#include "render/foam.h"
#include "render/job.h"
#include "render/liquid_look.h"
#include "render/plot.h"
#include "render/streamlines.h"
#include "render/surface_refiner.h"
#include "unit/render/common.h"

namespace fields_tests {
using namespace seiche;
using namespace seiche::render;
using namespace seiche::testing;
namespace fs = std::filesystem;

namespace {

// Liquid everywhere in the unit square or cube, with velocity u(x) at the faces' centres.
vdb::Frame flow(int dimension, int n, const std::function<Vec3(const Vec3&)>& u) {
  vdb::Frame frame;
  frame.dimension = dimension;
  frame.cell_size = 1.0 / n;
  const int depth = dimension == 3 ? n : 1;
  const vdb::Grid surface{"surface", vdb::GridKind::level_set, 3.0f / float(n), {}};
  vdb::Block values{{0, 0, 0}, {n, n, depth}, {}}, vectors{{0, 0, 0}, {n, n, depth}, {}};
  for (int c = 0; c < n * n * depth; ++c) {
    const Vec3 middle((c % n + 0.5) / n, (c / n % n + 0.5) / n, dimension == 3 ? (c / (n * n) + 0.5) / n : 0);
    values.values.push_back(-3.0f / float(n));
    for (int a = 0; a < 3; ++a)
      vectors.values.push_back(float(u(middle - 0.5 / n * Vec3::Unit(a * (a < dimension)))[a]));
  }
  set_grids(surface, values, vectors, frame);
  return frame;
}

void store(const ScratchRun& scratch, vdb::Frame frame, int number) {
  frame.number = number;
  frame.time = 0.1 * number;
  frame.creator = "test";
  write_file(scratch.folder / "frames" / ("frame.000" + std::to_string(number) + ".vdb"), vdb::encode(frame));
}

Vec3 rotation(const Vec3& x) {
  return Vec3(0.5 - x[1], x[0] - 0.5, 0) * 3;
}

RenderOptions options_for(const ScratchRun& scratch) {
  RenderOptions options;
  options.run = scratch.folder;
  return options;
}

}  // namespace

TEST_CASE("vorticity, divergence and components of linear flows are exact") {
  const auto all_near = [](const ScalarVolume& volume, float wanted, int margin) {
    bool near = true;
    for (int j = margin; j < volume.cells[1] - margin; ++j)
      for (int i = margin; i < volume.cells[0] - margin; ++i)
        near = near && std::abs(volume.at(i, j, volume.cells[2] / 2) - wanted) < 1e-4f;  // single precision over h
    return near;
  };
  for (const int dimension : {2, 3}) {
    const vdb::Frame turning = flow(dimension, 12, rotation);
    // frames lack the high faces of the last cells, whose centres then have the mean of one
    CHECK(all_near(quantity_of(turning, "vorticity"), 6, 2));
    CHECK(all_near(quantity_of(turning, "divergence"), 0, 0));
    const vdb::Frame growing = flow(dimension, 12, [](const Vec3& x) { return Vec3(2 * x[0], -0.5 * x[1], 0); });
    CHECK(all_near(quantity_of(growing, "divergence"), 1.5, 0));
    CHECK(all_near(quantity_of(growing, "vorticity"), 0, 0));
    CHECK(quantity_of(growing, "velocity_x").at(3, 5, 0) == Approx(2 * 3.5 / 12));
  }
  CHECK(has_sign("vorticity", 2));
  CHECK(!has_sign("vorticity", 3));
  CHECK(label_of("vorticity") == "vorticity (s⁻¹)");
}

TEST_CASE("a quantity that a frame lacks is refused with what it has and what to ask for") {
  vdb::Frame frame = flow(2, 8, rotation);
  CHECK_THAT(message_of([&] { quantity_of(frame, "pressure"); }),
             Catch::Contains("can show none, speed, vorticity, divergence, velocity_x, velocity_y;") &&
                 Catch::Contains("needs \"pressure\" in output.frames"));
  CHECK_THAT(message_of([&] { quantity_of(frame, "vortcity"); }), Catch::Contains("did you mean 'vorticity'?"));
  CHECK_THAT(message_of([&] { quantity_of(frame, "velocity_z"); }), Catch::Contains("holds no 'velocity_z'"));
  frame.grids.pop_back();
  CHECK_THAT(message_of([&] { quantity_of(frame, "speed"); }),
             Catch::Contains("can show none;") && Catch::Contains("needs \"velocity\" in output.frames"));
  CHECK_THAT(message_of([&] { velocity_of(frame, "--streamlines"); }),
             Catch::Contains("--streamlines: frame 0 holds no velocity") && Catch::Contains("output.frames"));
}

TEST_CASE("colours range over all frames, or one, or as given, and about zero for quantities with a sign") {
  const ScratchRun scratch;
  for (const int number : {0, 1})
    store(scratch, flow(2, 16, [&](const Vec3&) { return Vec3(1.0 + 3 * number, 0, 0); }), number);
  RenderOptions options = options_for(scratch);
  Job job = prepare_job(options, silent);
  CHECK(job.wants.quantity == "speed");
  CHECK(job.scale.low == 0);
  CHECK(job.scale.high == Approx(4));
  CHECK(job.scale.map->name == "viridis");
  options.per_frame = true;
  job = prepare_job(options, silent);
  CHECK(scale_of(job, load_frame(job.frames, 0, job.wants)).high == Approx(1));
  CHECK(scale_of(job, load_frame(job.frames, 1, job.wants)).high == Approx(4));
  options.per_frame = false;
  options.range = {-1.0f, 9.0f};
  options.color_map = "magma";
  job = prepare_job(options, silent);
  CHECK(job.scale.low == -1);
  CHECK(job.scale.high == 9);
  CHECK(job.scale.map->name == "magma");
  options = options_for(scratch);
  options.color = "velocity_x";
  job = prepare_job(options, silent);
  CHECK(job.scale.low == Approx(-4));
  CHECK(job.scale.high == Approx(4));
  CHECK(job.scale.map->name == "coolwarm");
}

TEST_CASE("options that do not fit are refused with what to do") {
  const auto refused = [](int dimension, bool has_quantity, const std::function<void(RenderOptions&)>& set) {
    RenderOptions options;
    set(options);
    return message_of([&] { require_fitting_options(options, dimension, has_quantity); });
  };
  using O = RenderOptions;
  CHECK_THAT(refused(3, false, [](O& o) { o.streamlines = true; }), Catch::Contains("--streamlines is for 2D runs"));
  CHECK_THAT(refused(3, false, [](O& o) { o.format = Format::svg; }), Catch::Contains("take png or exr"));
  CHECK_THAT(refused(2, false, [](O& o) { o.format = Format::exr; }), Catch::Contains("take svg, pdf or png"));
  CHECK_THAT(refused(2, false, [](O& o) { o.turntable = 8; }), Catch::Contains("--turntable is for 3D runs"));
  CHECK_THAT(refused(2, false, [](O& o) { o.foam = 1.0f; }), Catch::Contains("--foam is for 3D runs"));
  CHECK_THAT(refused(2, false, [](O& o) { o.transparent = true; }), Catch::Contains("--transparent is for 3D runs"));
  CHECK_THAT(refused(2, false, [](O& o) { o.camera = CameraSpec{}; }), Catch::Contains("--camera is for 3D runs"));
  CHECK_THAT(refused(2, false, [](O& o) { o.range = {0.0f, 1.0f}; }), Catch::Contains("add --color speed"));
  CHECK_THAT(refused(2, false, [](O& o) { o.per_frame = true; }), Catch::Contains("add --color speed"));
  CHECK_THAT(refused(2, true,
                     [](O& o) {
                       o.per_frame = true, o.range = {0.0f, 1.0f};
                     }),
             Catch::Contains("exclude each other"));
  CHECK_THAT(refused(3, false, [](O& o) { o.turntable = 8, o.camera_path = "x.csv"; }),
             Catch::Contains("exclude each other"));
  CHECK_THAT(refused(2, true, [](O& o) { o.format = Format::svg, o.animation = "film.mp4"; }),
             Catch::Contains("leave out --format svg"));
  CHECK(refused(2, true, [](O& o) { o.format = Format::pdf, o.streamlines = true; }).empty());
  CHECK(refused(3, false, [](O& o) { o.format = Format::exr, o.transparent = true, o.foam = 2.0f; }).empty());
  CHECK(parse_color_range("-1, 2.5") == std::array<float, 2>{-1, 2.5f});
  for (const char* text : {"", "1", "2,1", "1,1", "0,nan", "0,1,2", "a,b"})
    CHECK_THAT(message_of([&] { parse_color_range(text); }), Catch::Contains("as 0,2.5"));
}

TEST_CASE("streamlines of a rotation are circles that keep apart, and none run where nothing flows") {
  const FaceVelocity velocity = velocity_of(flow(2, 40, rotation), "test");
  const auto everywhere = [](const Vec2f&) { return true; };
  const float spacing = 0.06f;
  const std::vector<Polygon> lines = streamlines(velocity, spacing, everywhere);
  CHECK(lines.size() > 4);
  const Vec2f center(0.5f, 0.5f);
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const float radius = (lines[n].front() - center).norm();
    for (const Vec2f& x : lines[n]) {
      CHECK((x - center).norm() ==
            Approx(radius).margin(2e-3));  // midpoint rule, steps of 0.01 on radii of 0.05 and more
      for (std::size_t m = 0; m < n; ++m)
        for (const Vec2f& y : lines[m]) REQUIRE((x - y).norm() > 0.49f * spacing);
    }
    const Vec2f first = lines[n][0] - center, second = lines[n][1] - center;
    CHECK(first.x() * second.y() - first.y() * second.x() > 0);  // in the sense of the rotation
  }
  CHECK(streamlines(velocity, spacing, [](const Vec2f&) { return false; }).empty());
  CHECK(streamlines(velocity_of(flow(2, 8, [](const Vec3&) { return Vec3(0, 0, 0); }), ""), 0.1f, everywhere).empty());
}

TEST_CASE("foam is where the surface bends and is fast") {
  const int n = 24;
  ScalarVolume drop;
  drop.cells = {n, n, n};
  drop.h = 1.0f / n;
  for (int c = 0; c < n * n * n; ++c) {
    const Vec3f x = (Vec3f(float(c % n), float(c / n % n), float(c / (n * n))) + Vec3f::Constant(0.5f)) * drop.h;
    // a drop of two cells above a flat surface
    const float ball = (x - Vec3f(0.5f, 0.7f, 0.5f)).norm() - 2 * drop.h;
    drop.values.push_back(std::clamp(std::min(ball, x.y() - 0.3f), -3 * drop.h, 3 * drop.h));
  }
  FaceVelocity velocity{drop.cells, drop.lower, drop.h, {}};
  for (int c = 0; c < n * n * n; ++c) velocity.values.insert(velocity.values.end(), {0, -2, 0});
  const ScalarVolume fast = foam_of(drop, velocity, 1, 1), slow = foam_of(drop, velocity, 100, 1);
  CHECK(fast.sample({0.5f, 0.7f + 2 * drop.h, 0.5f}) > 0.3f);
  CHECK(fast.sample({0.2f, 0.3f, 0.2f}) == 0);
  CHECK(*std::max_element(slow.values.begin(), slow.values.end()) == 0);
}

TEST_CASE("liquids look like the material with their density and viscosity") {
  const auto named = [](double density, const std::string& viscosity) {
    LiquidSpec liquid;
    liquid.density = density;
    liquid.viscosity = viscosity;
    return material_of(liquid);
  };
  CHECK(named(1000, "0.0") == "water");
  CHECK(named(998.2, "1.002e-3") == "water");
  CHECK(named(1420, "10") == "honey");
  CHECK(named(1300, "50*(1+x)") == "honey");
  CHECK(named(1261, "1.41") == "glycerol");
  CHECK(named(911, "0.084") == "olive_oil");
  CHECK(named(13546, "0") == "mercury");
  CHECK(named(1030, "2e-3") == "milk");
  CHECK(named(1030, "0") == "water");
  CHECK(named(1060, "3.5e-3") == "blood");
  CHECK(liquid_look("milk").is_opaque());
  CHECK(!liquid_look("honey").is_opaque());
  CHECK_THAT(message_of([] { liquid_look("hony"); }), Catch::Contains("did you mean 'honey'?; liquids are water,"));
}

TEST_CASE("outlines of static and prescribed solids become those of the scene's shapes") {
  LoadedFrame frame;
  frame.dimension = 2;
  frame.time = 0.5;
  frame.domain = {Vec3f::Zero(), Vec3f(1, 1, 0.1f)};
  frame.phi = ScalarVolume{{10, 10, 1}, {0, 0, 0}, 0.1f, std::vector<float>(100, 0.3f)};
  SolidSpec box;
  box.shape.kind = "box";
  box.shape.lower = Vec3(0.22, 0.2, 0), box.shape.upper = Vec3(0.4, 0.51, 0);
  box.kind = SolidKind::kinematic;
  box.motion.translate = {"0.2*t", "0", "0"};
  // what a run samples on its grid: corners are cut
  const auto sampled = [&](double shift) {
    SolidMesh solids;
    solids.mesh.points = {
        {0.32 + shift, 0.23, 0}, {0.35 + shift, 0.2, 0}, {0.5 + shift, 0.48, 0}, {0.32 + shift, 0.5, 0}};
    solids.mesh.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    solids.solid = {0, 0, 0, 0};
    return solids;
  };
  frame.solids = sampled(0);
  const std::vector<SolidSpec> scene{box};
  SurfaceRefiner refiner(scene);
  refiner.refine(frame);
  std::vector<Vec3> corners;
  for (const auto& segment : frame.solids.mesh.segments) corners.push_back(frame.solids.mesh.points[segment[0]]);
  REQUIRE(corners.size() == 4);
  for (const Vec3& corner : {Vec3(0.32, 0.2, 0), Vec3(0.5, 0.2, 0), Vec3(0.5, 0.51, 0), Vec3(0.32, 0.51, 0)}) {
    const auto is_it = [&](const Vec3& x) { return (x - corner).norm() < 1e-12; };
    CHECK(std::any_of(corners.begin(), corners.end(), is_it));
  }
  frame.solids = sampled(0.3);  // elsewhere than the scene has it: the frame is right
  refiner.refine(frame);
  CHECK(frame.solids.mesh.points[0] == Vec3(0.62, 0.23, 0));
}

TEST_CASE("the outline of a block of liquid is straight up to its corner, and turned with the block") {
  ScalarVolume phi{{10, 10, 1}, {0, 0, 0}, 0.1f, {}}, turned = phi;
  const auto distance = [](double x, double y) {  // to a block from the origin, its corner on lines of the grid
    const double a = x - 0.5, b = y - 0.6;
    return float(std::max(a, b) < 0 ? std::max(a, b) : std::hypot(std::max(a, 0.0), std::max(b, 0.0)));
  };
  for (int c = 0; c < 100; ++c) {
    const double x = 0.1 * (c % 10 + 0.5), y = 0.1 * (c / 10 + 0.5);
    phi.values.push_back(distance(x, y)), turned.values.push_back(distance(y, x));
  }
  const auto farthest = [](const ScalarVolume& of, int axis) {
    double most = 0;
    for (const auto& outline : liquid_outlines(of))
      for (const auto& point : outline) most = std::max(most, double(point[axis]));
    return most;
  };
  // Beyond the corner the distance is round, which moves the outline by 0.031 cells; a knob had 0.08.
  CHECK(farthest(phi, 0) == Approx(0.5).margin(0.004));
  CHECK(farthest(phi, 1) == Approx(0.6).margin(0.004));
  CHECK(farthest(turned, 1) == Approx(farthest(phi, 0)).margin(1e-7));
  CHECK(farthest(turned, 0) == Approx(farthest(phi, 1)).margin(1e-7));
}

TEST_CASE("the contour of a formula moves with its solid from frame to frame and is not made again") {
  SolidSpec disc;
  disc.shape.kind = "expression";
  disc.shape.phi = "(x-0.3)^2 + (y-0.5)^2 - 0.15^2";
  disc.kind = SolidKind::kinematic;
  disc.motion.translate = {"0.137*t", "0", "0"};
  const std::vector<SolidSpec> scene{disc};
  SurfaceRefiner refiner(scene);
  const auto surface_at = [&](double time, double turn) {
    LoadedFrame frame;
    frame.dimension = 2;
    frame.time = time;
    frame.domain = {Vec3f::Zero(), Vec3f(1, 1, 0.1f)};
    frame.phi = ScalarVolume{{10, 10, 1}, {0, 0, 0}, 0.1f, std::vector<float>(100, 0.3f)};
    for (int n = 0; n < 8; ++n) {  // facets of the frame lie elsewhere on the circle each time
      const double angle = turn + 2 * M_PI * n / 8;
      frame.solids.mesh.points.emplace_back(0.3 + 0.137 * time + 0.15 * std::cos(angle), 0.5 + 0.15 * std::sin(angle),
                                            0);
      frame.solids.mesh.segments.push_back({n, (n + 1) % 8});
      frame.solids.solid.push_back(0);
    }
    refiner.refine(frame);
    return frame.solids.mesh;
  };
  const SurfaceMesh first = surface_at(0, 0), later = surface_at(1, 0.3);
  REQUIRE(first.segments.size() > 16);
  REQUIRE(later.points.size() == first.points.size());
  for (std::size_t p = 8; p < first.points.size(); ++p)
    CHECK((later.points[p] - first.points[p] - Vec3(0.137, 0, 0)).norm() < 1e-12);
}

}  // namespace fields_tests
