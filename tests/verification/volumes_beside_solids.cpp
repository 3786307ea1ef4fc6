// Volumes in cells (liquid.volume = "cells") beside solids that stand still.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/error.h"
#include "base/solid_spec.h"
#include "volume_scenes.h"

namespace volumes_beside_solids_tests {
using namespace seiche;
using test::kept_in_cells, test::run_keeping_volume;

namespace {

SolidSpec& add_static(Scene& s, const std::string& kind) {
  SolidSpec& solid = s.solids.emplace_back();
  solid.name = "solid";
  solid.kind = SolidKind::fixed;
  solid.shape.kind = kind;
  solid.shape.where = "test";
  return solid;
}

SolidSpec& add_box(Scene& s, const Vec3& lower, const Vec3& upper) {
  SolidSpec& solid = add_static(s, "box");
  solid.shape.lower = lower, solid.shape.upper = upper;
  return solid;
}

SolidSpec& add_sphere(Scene& s, const Vec3& center, double radius) {
  SolidSpec& solid = add_static(s, "sphere");
  solid.shape.center = center, solid.shape.radius = radius;
  return solid;
}

// Least level set right of x, m.
double least_beyond(const Simulation& sim, double x, double h) {
  const FrameField f = sim.frame_field("surface");
  double least = 1e300;
  std::size_t n = 0;
  for (int k = f.lower[2]; k < f.upper[2]; ++k)
    for (int j = f.lower[1]; j < f.upper[1]; ++j)
      for (int i = f.lower[0]; i < f.upper[0]; ++i, ++n)
        if (i * h > x) least = std::min(least, double(f.values[n]));
  return least;
}

// Shares of liquid right of x: their sum, and the largest in size.
struct SharesBeyond {
  double sum = 0, largest = 0;
};
SharesBeyond shares_beyond(const Simulation& sim, double x, double h) {
  const CheckpointData data = sim.save();
  const auto liquid = std::find_if(data.fields.begin(), data.fields.end(),
                                   [](const FieldRecord& field) { return field.name == "liquid"; });
  REQUIRE(liquid != data.fields.end());
  const std::vector<double> shares = liquid->values.unpack();
  const int row = liquid->upper[0] - liquid->lower[0];
  SharesBeyond r;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    if ((liquid->lower[0] + int(n) % row) * h < x - 1e-9) continue;
    r.sum += shares[n];
    r.largest = std::max(r.largest, std::abs(shares[n]));
  }
  return r;
}

}  // namespace

TEST_CASE("volumes beside solids: liquid at rest in a turned box stays at rest", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 24 : 12, "y-0.507");
    SolidSpec& box = add_box(s, {-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3});
    box.shape.transform.rotate = {dim == 2 ? Vec3(0, 0, 1) : Vec3(1, 2, 3), 30};
    box.shape.transform.translate = {0.5, 0.5, dim == 2 ? 0 : 0.5};
    box.shape.invert = true;
    const StepStats end = run_keeping_volume(s, 0.5)->stats();
    CHECK(end.max_speed < 1e-5);
    CHECK(end.volume_spilled < 1e-6 * end.liquid_volume);
  }
}

TEST_CASE("volumes beside solids: a dam break among posts keeps its volume", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 40 : 16, "max(x-0.3,y-0.5)");
    add_sphere(s, {0.6, 0.1, 0.3}, 0.14);
    add_box(s, {0.75, 0.3, 0.4}, {0.9, 0.42, 0.8}).shape.transform.rotate = {Vec3(0, 0, 1), 10};
    const auto sim = run_keeping_volume(s, 0.8);
    const StepStats start = make_simulation(s, Communicator())->stats(), end = sim->stats();
    WARN(dim << "D: spilled " << end.volume_spilled / end.liquid_volume);
    CHECK(end.volume_spilled < 0.02 * end.liquid_volume);  // 0.006, 0.010
    CHECK(end.kinetic_energy + end.potential_energy < 1.03 * start.potential_energy);
  }
}

// Cells of both sides touch within the wall.
TEST_CASE("volumes beside solids: a wall of 1.4 cells lets nothing through", "[volumes]") {
  for (const int dim : {2, 3}) {
    const int cells = dim == 2 ? 32 : 12;
    const double h = 1.0 / cells, low = 0.5 + 0.4 * h;
    Scene s = kept_in_cells(dim, cells, "max(x-0.5,y-0.3-0.6*x)");
    add_box(s, {low, -1, -1}, {low + 1.4 * h, 2, 2});
    const auto sim = run_keeping_volume(s, 1);
    CHECK(least_beyond(*sim, low + h, h) > 0.5 * h);
    const SharesBeyond beyond = shares_beyond(*sim, low + 1.4 * h, h);
    CHECK(std::abs(beyond.sum) < 1e-12 * cells);  // rounding: nothing comes through
    CHECK(beyond.largest < 5e-4);                 // 1e-4, 4e-7: cells in the wall borrow from those behind
  }
}

TEST_CASE("volumes beside solids: full cells stay full in a flow past a sphere", "[volumes]") {
  for (const int dim : {2, 3}) {
    Scene s = kept_in_cells(dim, dim == 2 ? 24 : 12, "-1");
    s.gravity = Vec3::Zero();
    s.liquid.velocity = {"1", "0", "0"};
    for (SideSpec& side : s.domain.sides[0]) side.type = SideType::periodic;
    add_sphere(s, {0.5, 0.47, 0.52}, 0.23);
    const StepStats end = run_keeping_volume(s, 1)->stats();
    CHECK(end.volume_spilled < 1e-6 * end.liquid_volume);
    CHECK(end.volume_drifting == 0);
  }
}

// Ten steps of 0.03 m. In first order the volumes stood still in the first one.
TEST_CASE("volumes beside solids: a drop flies on from the first step", "[volumes]") {
  for (const TimeScheme scheme : {TimeScheme::first_order, TimeScheme::second_order})
    for (const int dim : {2, 3}) {
      Scene s = kept_in_cells(dim, dim == 2 ? 32 : 20,
                              dim == 2 ? "sqrt((x-0.4)^2+(y-0.7)^2)-0.15" : "sqrt((x-0.4)^2+(y-0.7)^2+(z-0.5)^2)-0.15");
      s.gravity = Vec3::Zero();
      s.liquid.velocity = {"1", "0", "0"};
      for (SideSpec& side : s.domain.sides[0]) side.type = SideType::periodic;
      s.time.scheme = scheme;
      s.time.fixed_step = 0.03;
      add_sphere(s, {0.5, 0.2, 0.5}, 0.11);
      const auto sim = run_keeping_volume(s, 0.3);
      const double h = s.domain.cell_size;
      CHECK(least_beyond(*sim, 0.85 + h, h) > 0);  // it ends at x = 0.85
      CHECK(least_beyond(*sim, 0.85 - 1.5 * h, h) < 0);
    }
}

TEST_CASE("volumes beside solids: a solid thinner than a cell is refused", "[volumes]") {
  Scene s = kept_in_cells(2, 16, "y-0.5");
  add_box(s, {0.5, -1, 0}, {0.52, 2, 1});
  CHECK_THROWS_WITH(make_simulation(s, Communicator()), Catch::Matchers::Contains("thinner than a cell"));
}

}  // namespace volumes_beside_solids_tests
