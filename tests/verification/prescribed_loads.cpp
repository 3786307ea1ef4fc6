// Loads on static and prescribed solids against the exact ones of liquid at rest.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace prescribed_loads_tests {
using namespace seiche;

namespace {

constexpr double rho = 1000, g = 9.81;

SolidSpec still(SolidSpec solid) {
  solid.kind = SolidKind::fixed;
  return solid;
}

Scene pool_scene(int dim, int cells, double level) {
  Scene s = test::box_scene(dim, cells);
  s.gravity = {0, -g, 0};
  test::add_pool(s, level);
  s.time.fixed_step = 1e-3;
  s.solver.tolerance = 1e-12;
  return s;
}

// The loads on all solids after the first step.
std::vector<SolidState> loads_in(const Scene& s) {
  const auto sim = make_simulation(s, Communicator());
  sim->step(1);
  return sim->solids();
}

}  // namespace

// A box that stands still, half under a level anywhere in a cell. Its buoyancy is that of the part under water. Loads
// by shares of faces alone are off by up to rho g h/2 on its bottom, 10 % here.
TEST_CASE("a static box in the surface bears the weight of the water that it displaces") {
  for (const int dim : {2, 3}) {
    const int cells = dim == 2 ? 24 : 16;
    const double h = 1.0 / cells, depth = dim == 2 ? 1 : 0.5;
    for (const double part : {0.0, 0.13, 0.5, 0.77}) {
      const double bottom = 0.25 + part * h, level = 0.5 + 0.3 * h;
      Scene s = pool_scene(dim, cells, level);
      s.solids = {still(test::rigid_box("box", {0.4, 0.5, 0.5}, {0.5, bottom + 0.25, dim == 2 ? 0 : 0.5}, 1))};
      const SolidState box = loads_in(s)[0];
      const double exact = rho * g * 0.4 * depth * (level - bottom);
      INFO(dim << "D, bottom " << part << " of a cell above a line");
      CHECK(box.force[1] == Approx(exact).epsilon(1e-9));  // pressure is linear: rounding and the solve's tolerance
      CHECK(std::abs(box.force[0]) < 1e-9 * exact);
      CHECK(box.torque.norm() < 1e-9 * exact);
    }
  }
}

// A gate from the floor through the surface, between levels H and d: F = rho g (H^2 - d^2)/2 to the dry side, its
// moment about the floor rho g (H^3 - d^3)/6; the reference point lies at half its height.
TEST_CASE("a gate that stands on the floor holds back two levels exactly") {
  for (const double part : {0.0, 0.21, 0.5, 0.83}) {
    const int cells = 32;
    const double h = 1.0 / cells, left = 0.5 + part * h, H = 0.6 + 0.4 * h, d = 0.2;
    Scene s = pool_scene(2, cells, d);
    LiquidRegionSpec high;
    high.shape.kind = "box";
    high.shape.upper = {left + 2 * h, H, 0};
    high.shape.where = "test";
    s.liquid.regions.push_back(high);
    s.solids = {still(test::rigid_box("gate", {4 * h, 1, 0}, {left + 2 * h, 0.5, 0}, 1))};
    const SolidState gate = loads_in(s)[0];
    const double force = rho * g * (H * H - d * d) / 2, moment = rho * g * (H * H * H - d * d * d) / 6;
    // Beside a gate that cuts cells the control of volume moves both levels by some 1e-5 cells in the first step.
    const double error = part == 0 ? 1e-9 : 1e-5;
    INFO("left side " << part << " of a cell beyond a line");
    CHECK(gate.force[0] == Approx(force).epsilon(error));
    CHECK(std::abs(gate.force[1]) < 1e-8 * force);
    CHECK(gate.torque[2] == Approx(0.5 * force - moment).epsilon(error));
  }
}

// A plane's slope carries the water above it; a round vessel all of its water. Facets of the circle are 256.
TEST_CASE("a slope and a round vessel carry the water that rests on them") {
  Scene slope = pool_scene(2, 32, 0.5);
  SolidSpec plane;
  plane.name = "slope";
  plane.shape.kind = "plane";
  plane.shape.point = {0, 0.2, 0};
  plane.shape.normal = {-0.3, 1, 0};
  plane.shape.where = "test";
  slope.solids = {plane};
  const double low = 0.2, high = 0.5, volume = (high - low) / 0.3 * (high - low) / 2;  // a triangle; it ends at x = 1
  CHECK(loads_in(slope)[0].force[1] == Approx(-rho * g * volume).epsilon(1e-6));

  Scene vessel = test::box_scene(2, 40);
  vessel.gravity = {0, -g, 0};
  vessel.time.fixed_step = 1e-3;
  vessel.solver.tolerance = 1e-12;
  test::add_liquid(vessel, "max(y - 0.5, sqrt((x - 0.5)^2 + (y - 0.5)^2) - 0.5)");
  SolidSpec round = still(test::rigid_ball("vessel", 0.4, {0.5, 0.5, 0}, 1));
  round.shape.invert = true;
  vessel.solids = {round};
  const double half = 0.5 * test::pi * 0.16;
  CHECK(loads_in(vessel)[0].force[1] == Approx(-rho * g * half).epsilon(2e-3));  // its surface, cut by the grid
}

// Two boxes, the second stacked on the first: no water acts where they touch.
TEST_CASE("no water acts on static solids where they touch") {
  Scene s = pool_scene(2, 32, 0.8);
  s.solids = {still(test::rigid_box("low", {0.3, 0.25, 0}, {0.5, 0.125, 0}, 1)),
              still(test::rigid_box("high", {0.1875, 0.2, 0}, {0.5, 0.35, 0}, 1))};  // its sides on grid lines
  const std::vector<SolidState> loads = loads_in(s);
  const double on_low = rho * g * 0.1125 * (0.8 - 0.25),
               on_high = rho * g * 0.1875 * (0.8 - 0.45);  // tops that are wet
  CHECK(loads[0].force[1] == Approx(-on_low).epsilon(1e-8));
  CHECK(loads[1].force[1] == Approx(-on_high).epsilon(1e-8));
}

TEST_CASE("a prescribed solid that does not move bears what a static one does") {
  Scene s = pool_scene(2, 24, 0.5);
  s.solids = {still(test::rigid_box("box", {0.4, 0.5, 0}, {0.5, 0.53, 0}, 1))};
  const SolidState fixed = loads_in(s)[0];
  s.solids[0].kind = SolidKind::kinematic;
  const SolidState led = loads_in(s)[0];
  CHECK(led.force[1] == Approx(fixed.force[1]).epsilon(1e-10));
  CHECK(fixed.force[1] == Approx(rho * g * 0.4 * 0.22).epsilon(1e-9));
}

}  // namespace prescribed_loads_tests
