// A thin plate on a hinge along its edge, let go in a large tank full of liquid.
#include <catch2/catch.hpp>

#include "joint_scenes.h"

namespace joints_plate_tests {
using namespace seiche;
using test::hinge;

namespace {

constexpr double half_chord = 0.25, thickness = 0.05;  // m; cells

// The added inertia found over the exact one, 9 pi rho a^4/8 for a chord of 2a. The plate lies along faces of the grid.
// In 3D the tank is four cells deep, and the plate ends just before its sides, which slip.
double added_inertia(int dimension, double cell, double half_tank) {
  constexpr double density = 7800, g = 9.81;
  Scene s = test::swing_scene(dimension, half_tank, cell, g);
  double depth = 1;
  if (dimension == 3) {
    s.domain.lower[2] = -2 * cell, s.domain.upper[2] = 2 * cell, s.domain.cells[2] = 4;
    depth = 3.99 * cell;
  }
  test::add_liquid(s, "-1");
  const Vec3 size(2 * half_chord, thickness * cell, depth);
  s.solids = {test::rigid_box("plate", size, {half_chord, 0, 0}, density)};
  s.joints = {hinge("edge", "plate", "world", Vec3::Zero(), dimension == 3 ? Vec3(0, 0, 1) : Vec3(0, 0, 0))};
  s.solver.tolerance = 1e-10;
  s.time.fixed_step = 0.002;
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < 3; ++n) (void)sim->step(1);
  const double volume = size[0] * size[1] * depth, mass = density * volume;
  const double own = mass * (std::pow(size[0], 2) / 3 + std::pow(size[1], 2) / 12);
  const double torque = (mass - 1000 * volume) * g * half_chord, spin = -sim->joints()[0].rate / sim->time();
  const double exact = depth * 9 * test::pi / 8 * 1000 * std::pow(half_chord, 4);
  WARN(dimension << "D, " << 2 * half_chord / cell << " cells a chord, tank of " << half_tank / half_chord
                 << " chords: added inertia off by " << 100 * ((torque / spin - own) / exact - 1) << " %");
  return (torque / spin - own) / exact;
}

}  // namespace

// The tank's sides add about a^2/(2 R^2): 0.2 % where it is eight chords wide.
TEST_CASE("joints: a plate hinged at an edge sets off with its added inertia", "[joints]") {
  const double coarse = added_inertia(2, 1.0 / 16, 2), fine = added_inertia(2, 1.0 / 32, 2);
  CHECK(std::abs(coarse - 1) <= 0.03);                         // 2.3 %
  CHECK(std::abs(fine - 1) <= 0.02);                           // 1.5 %
  CHECK(std::abs(added_inertia(3, 1.0 / 16, 2) - 1) <= 0.03);  // 2.5 %
}

TEST_CASE("joints: the same in a tank of sixteen chords", "[joints][long]") {
  CHECK(std::abs(added_inertia(2, 1.0 / 32, 4) - 1) <= 0.01);  // 0.9 %
}

}  // namespace joints_plate_tests
