// A thin plate on a hinge along its edge, let go in a large tank full of liquid.
#include <catch2/catch.hpp>

#include "joint_scenes.h"

namespace joints_plate_tests {
using namespace seiche;
using test::hinge;

namespace {

constexpr double half_chord = 0.25, thickness = 0.05, g = 9.81;  // m; cells; m/s^2

// The plate lies along faces of the grid. In 3D the tank is four cells deep, and the plate ends just before its sides,
// which slip.
struct PlateScene {
  Scene scene;
  double mass, volume, own,
      exact;  // own inertia about the hinge, the exact added one: 9 pi rho a^4/8 for a chord of 2a
};

PlateScene plate_in_tank(int dimension, double cell, double half_tank) {
  constexpr double density = 7800;
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
  const double volume = size[0] * size[1] * depth, mass = density * volume;
  return {s, mass, volume, mass * (std::pow(size[0], 2) / 3 + std::pow(size[1], 2) / 12),
          depth * 9 * test::pi / 8 * 1000 * std::pow(half_chord, 4)};
}

// The added inertia that a torque shows over the exact one.
double added_share(const PlateScene& plate, double torque) {
  const auto sim = make_simulation(plate.scene, Communicator());
  for (int n = 0; n < 3; ++n) (void)sim->step(1);
  const double spin = std::abs(sim->joints()[0].rate) / sim->time();
  return (torque / spin - plate.own) / plate.exact;
}

double added_inertia(int dimension, double cell, double half_tank) {
  const PlateScene plate = plate_in_tank(dimension, cell, half_tank);
  const double share = added_share(plate, (plate.mass - 1000 * plate.volume) * g * half_chord);
  WARN(dimension << "D, " << 2 * half_chord / cell << " cells a chord, tank of " << half_tank / half_chord
                 << " chords: added inertia off by " << 100 * (share - 1) << " %");
  return share;
}

}  // namespace

// The tank's sides add about a^2/(2 R^2): 0.2 % where it is eight chords wide.
TEST_CASE("joints: a plate hinged at an edge sets off with its added inertia", "[joints]") {
  const double coarse = added_inertia(2, 1.0 / 16, 2), fine = added_inertia(2, 1.0 / 32, 2);
  CHECK(std::abs(coarse - 1) <= 0.03);                         // 2.3 %
  CHECK(std::abs(fine - 1) <= 0.02);                           // 1.5 %
  CHECK(std::abs(added_inertia(3, 1.0 / 16, 2) - 1) <= 0.03);  // 2.5 %
}

// Without gravity nothing flows before; the first step of second order finds all of it.
TEST_CASE("joints: a motor or a spring sets a plate off with the added inertia that gravity shows", "[joints]") {
  const double fallen = added_inertia(2, 1.0 / 16, 2), torque = 5;
  for (const bool capped : {true, false})
    for (const TimeScheme scheme : {TimeScheme::first_order, TimeScheme::second_order}) {
      PlateScene plate = plate_in_tank(2, 1.0 / 16, 2);
      plate.scene.gravity = Vec3::Zero();
      plate.scene.time.scheme = scheme;
      JointSpec& edge = plate.scene.joints[0];
      if (capped) edge.motor.emplace().speed = "1e3", edge.motor->torque = torque;
      if (!capped) edge.spring.emplace().rest = 1e4, edge.spring->stiffness = torque / (1e4 * test::pi / 180);
      const double share = added_share(plate, torque);
      WARN((capped ? "motor, " : "spring, ") << int(scheme) << ": " << share << ", by gravity " << fallen);
      CHECK(share == Approx(fallen).epsilon(1e-4));  // measured: 1e-5
    }
}

TEST_CASE("joints: the same in a tank of sixteen chords", "[joints][long]") {
  CHECK(std::abs(added_inertia(2, 1.0 / 32, 4) - 1) <= 0.01);  // 0.9 %
}

}  // namespace joints_plate_tests
