// Joints that hold patches of elastic solids.
#include <catch2/catch.hpp>

#include "elastic_scenes.h"
#include "joint_scenes.h"

namespace joints_elastic_tests {
using namespace seiche;
using test::add_liquid, test::elastic_box, test::energy_of, test::hinge, test::joint, test::pi;

namespace {

ShapeSpec region(const Vec3& lower, const Vec3& upper) {
  ShapeSpec shape;
  shape.kind = "box";
  shape.lower = lower;
  shape.upper = upper;
  shape.where = "test";
  return shape;
}

// A bar of a metre and its half thickness, from the origin along x; stiff for its weight.
constexpr double half = 0.1;
SolidSpec soft_bar(int dim, double modulus) {
  return elastic_box("bar", {0, -half, -half}, {1, half, half}, 1000, {modulus, 0.3}, dim == 2 ? 0.1 : 0.2);
}

// The bar on a hinge at its upper left edge's patch.
Scene swinging(int dim, double modulus) {
  Scene s = test::swing_scene(dim, 1.4, 0.14);
  s.solids = {soft_bar(dim, modulus)};
  s.joints = {hinge("pin", "bar", "world", {0, 0, 0}, dim == 3 ? Vec3(0, 0, 1) : Vec3(0, 0, 0))};
  s.joints[0].region = region({-0.01, -1, -1}, {0.25, 1, 1});
  s.time.frame_rate = 0.1;
  return s;
}

}  // namespace

// T/T_0 = 1.1803406 from the horizontal, T_0 = 2 pi sqrt(I/(m g d)). The bar's own give takes the rest.
TEST_CASE("joints: an elastic bar on a hinge swings as a rigid one", "[joints][elastic]") {
  for (const int dim : {2, 3}) {
    const double inertia = 1.0 / 3 + half * half / 3, exact = 2 * pi * std::sqrt(inertia / (9.81 * 0.5)) * 1.1803406;
    std::array<double, 2> error{}, energy{};
    for (const int level : {0, 1}) {
      Scene s = swinging(dim, 1e9);
      s.time.fixed_step = exact / (level == 0 ? 200 : 400);
      const auto sim = make_simulation(s, Communicator());
      test::Crossings through;
      double start = 0, least = 1e300, most = -1e300;
      while (sim->time() < (dim == 2 ? 0.8 : 0.3) * exact) {
        const StepStats now = sim->step(2 * exact);
        if (now.step == 1) start = energy_of(now);
        least = std::min(least, energy_of(now)), most = std::max(most, energy_of(now));
        CHECK(now.joint_gap <= 1e-9);
        through.add(sim->time(), sim->solids()[0].position[0]);
      }
      energy[level] = std::max(most - start, start - least);
      if (!through.times.empty()) error[level] = 4 * through.times[0] / exact - 1;
    }
    WARN(dim << "D: period off by " << error[0] << ", " << error[1] << "; energy by " << energy[0] << ", " << energy[1]
             << " J of " << 1000 * (dim == 2 ? 0.2 : 0.04) * 9.81 * 0.5);
    CHECK(std::abs(error[1]) <= 5e-4);    // 3.1e-4, of second order
    CHECK(energy[1] <= 0.3 * energy[0]);  // second order
  }
}

// Backward Euler keeps momentum to rounding; BDF2 does where motions are smooth.
TEST_CASE("joints: rigid and elastic bodies that are joined keep their momentum", "[joints][elastic]") {
  for (const int dim : {2, 3})
    for (const JointKind kind : {JointKind::weld, JointKind::hinge, JointKind::slider, JointKind::distance}) {
      Scene s = test::swing_scene(dim, 2, 0.2, 0);
      s.time.scheme = TimeScheme::first_order;
      s.time.fixed_step = 0.01;
      s.solids = {soft_bar(dim, 1e6), test::rigid_box("block", {0.3, 0.3, 0.3}, {-0.1, 0, 0}, 300)};
      s.solids[1].rigid.velocity = Vec3(0.3, 0.5, 0);
      s.solids[1].rigid.angular_velocity = Vec3(0, 0, 1);
      s.joints = {joint("j", kind, "bar", "block", {0, 0, 0})};
      s.joints[0].region = region({-0.01, -1, -1}, {0.25, 1, 1});
      s.joints[0].to = Vec3(-0.2, 0.1, 0);
      if (kind == JointKind::slider || (kind == JointKind::hinge && dim == 3)) s.joints[0].axis = Vec3::UnitX();
      const auto sim = make_simulation(s, Communicator());
      const Vec3 start = sim->stats().momentum;
      double worst = 0;
      for (int n = 0; n < 10; ++n) worst = std::max(worst, (sim->step(10).momentum - start).norm() / start.norm());
      CAPTURE(dim, int(kind), worst);
      // Sliders and rods turn between the two sides' times by an angle of first order.
      const bool turns = kind == JointKind::slider || kind == JointKind::distance;
      CHECK(worst <= (turns ? 0.05 : 1e-11));
    }
}

// Statics of a cantilever: the weld bears its weight, and its moment about the joint.
TEST_CASE("joints: the weld of an elastic beam bears its weight and its moment", "[joints][elastic]") {
  for (const int dim : {2, 3}) {
    Scene s = test::swing_scene(dim, 1.4, 0.14);
    s.solids = {soft_bar(dim, 1e7)};
    s.solids[0].elastic.mass_damping = 20;
    s.joints = {joint("wall", JointKind::weld, "bar", "world", {0, 0, 0})};
    s.joints[0].region = region({-0.01, -1, -1}, {0.25, 1, 1});
    s.time.fixed_step = 0.02;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 100; ++n) (void)sim->step(10);
    const JointReport wall = sim->joints()[0];
    const Vec3 middle = sim->solids()[0].position;
    const double weight = 1000 * (dim == 2 ? 0.2 : 0.04) * 9.81;
    CAPTURE(dim, wall.force, wall.torque, middle);
    CHECK(wall.force[1] == Approx(weight).epsilon(1e-6));
    CHECK(wall.torque[2] == Approx(weight * middle[0]).epsilon(1e-6));
    CHECK(middle[1] < -1e-3);  // it bends
  }
}

// A hard and a soft box side by side in liquid, on the grid's lines: the first's weld to the world bears the weight of
// both less the buoyancy of both, and the weld between them the soft one's, and the pressure on its far side.
TEST_CASE("joints: liquid at rest loads a hard and a soft box as one", "[joints][elastic]") {
  for (const int dim : {2, 3}) {
    Scene s = test::swing_scene(dim, 0.5, 0.05);
    add_liquid(s, "y-0.3");
    s.solids = {elastic_box("soft", {-0.2, -0.1, -0.1}, {0, 0.1, 0.1}, 2000, {1e9, 0.3}, 0.1),
                test::rigid_box("hard", {0.2, 0.2, 0.2}, {0.1, 0, 0}, 500)};
    s.joints = {joint("root", JointKind::weld, "soft", "hard", {0, 0, 0}),
                joint("stand", JointKind::weld, "hard", "world", {0.1, 0, 0})};
    s.joints[0].region = region({-0.08, -1, -1}, {0.01, 1, 1});
    s.solver.tolerance = 1e-10;
    s.time.fixed_step = 0.02;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 30; ++n) (void)sim->step(10);
    const double volume = dim == 2 ? 0.04 : 0.008, deep = 0.3, side = dim == 2 ? 0.2 : 0.04;
    const Vec3 root = sim->joints()[0].force, stand = sim->joints()[1].force;
    CAPTURE(dim, root, stand);
    const double scale = 1e-4;  // the soft box gives way by p/E
    CHECK(root[1] == Approx(1000 * volume * 9.81).epsilon(scale));
    CHECK(root[0] == Approx(-1000 * 9.81 * deep * side).epsilon(scale));
    CHECK(stand[1] == Approx((2500 - 2000) * volume * 9.81).epsilon(scale));
    CHECK(std::abs(stand[0]) <= scale * std::abs(root[0]));
  }
}

}  // namespace joints_elastic_tests
