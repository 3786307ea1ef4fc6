// Jointed rigid solids that bounce.
#include <catch2/catch.hpp>

#include <Eigen/Dense>

#include "joint_scenes.h"
#include "restitution_scenes.h"

namespace restitution_joints_tests {
using namespace seiche;
using test::set_restitution;

namespace {

// Two balls on a bar fall flat onto the floor at 1 m/s.
Scene dumbbell(int dim, JointKind kind) {
  Scene s = test::box_scene(dim, 50);
  s.gravity = {0, 0, 0};
  s.time.max_step = 0.004;
  const double z = dim == 3 ? 0.5 : 0;
  s.solids = {test::rigid_box("bar", {0.48, 0.04, dim == 3 ? 0.04 : 0.0}, {0.5, 0.2, z}, 1000)};
  for (const double x : {0.3, 0.7}) {
    s.solids.push_back(test::rigid_ball(x < 0.5 ? "left" : "right", 0.05, {x, 0.2, z}, 1000));
    s.joints.push_back(test::joint(x < 0.5 ? "one" : "two", kind, s.solids.back().name, "bar", {x, 0.2, z}));
    s.joints.back().axis = dim == 3 ? Vec3(0, 0, 1) : Vec3(0, 0, 0);
  }
  for (SolidSpec& solid : s.solids) solid.rigid.velocity = {0, -1, 0};
  set_restitution(s, 0.5, {"*", "domain"});
  return s;
}

}  // namespace

// Each ball's impulse moves the other by the bar. Measured: 0.4999 for all; 0.45 when the balls' masses alone counted.
TEST_CASE("jointed solids that meet at two places part from both by the coefficient", "[restitution]") {
  for (const int dim : {2, 3})
    for (const JointKind kind : {JointKind::weld, JointKind::hinge}) {
      const auto sim = make_simulation(dumbbell(dim, kind), Communicator());
      while (sim->time() < 0.25) (void)sim->step(0.25);
      for (const SolidState& solid : sim->solids()) {
        WARN(dim << "D, " << (kind == JointKind::weld ? "weld" : "hinge") << ": " << solid.velocity[1] << " m/s");
        CHECK(solid.velocity[1] == Approx(0.5).epsilon(0.005));
        CHECK(std::abs(solid.angular_velocity[2]) < 1e-6);
      }
    }
}

namespace {

// A rod on a hinge that turns at 1 rad/s and meets a peg near its end.
Scene rod_and_peg(int dim) {
  Scene s = test::box_scene(dim, 50);
  s.gravity = {0, 0, 0};
  s.time.max_step = 0.004;
  const double thick = dim == 3 ? 0.1 : 0, z = dim == 3 ? 0.5 : 0;
  s.solids = {test::rigid_box("rod", {0.04, 0.6, thick}, {0.5, 0.6, z}, 1000),
              test::rigid_ball("peg", 0.04, {0.6, 0.35, z}, 1)};
  s.solids[0].rigid.angular_velocity = {0, 0, 1};
  s.solids[0].rigid.velocity = {0.28, 0, 0};
  s.solids[1].kind = SolidKind::fixed;
  s.joints = {test::hinge("pivot", "rod", "world", {0.5, 0.88, z}, dim == 3 ? Vec3(0, 0, 1) : Vec3(0, 0, 0))};
  set_restitution(s, 0.5, {"rod", "peg"});
  return s;
}

}  // namespace

// The momentum that the peg does not take goes through the hinge. Measured: 0.5007 and 0.5007.
TEST_CASE("a pendulum that meets a peg turns back by the coefficient", "[restitution]") {
  for (const int dim : {2, 3}) {
    const auto sim = make_simulation(rod_and_peg(dim), Communicator());
    while (sim->time() < 0.3) (void)sim->step(0.3);
    const SolidState rod = sim->solids()[0];
    WARN(dim << "D: " << rod.angular_velocity[2] << " rad/s");
    CHECK(rod.angular_velocity[2] == Approx(-0.5).epsilon(0.01));
    CHECK(rod.velocity[0] == Approx(0.28 * rod.angular_velocity[2]).epsilon(0.01));
  }
}

namespace {

// Two bars in a line, joined by a hinge, that move across it at 1 m/s. The lower one meets a peg; so does the upper one
// if `both`.
Scene hinged_bars(bool both) {
  Scene s = test::box_scene(2, 50);
  s.gravity = {0, 0, 0};
  s.time.max_step = 0.002;
  s.solids = {test::rigid_box("low", {0.04, 0.3, 0}, {0.4, 0.36, 0}, 1000),
              test::rigid_box("high", {0.04, 0.3, 0}, {0.4, 0.66, 0}, 1000),
              test::rigid_ball("peg", 0.04, {0.5, 0.26, 0}, 1), test::rigid_ball("other", 0.04, {0.5, 0.62, 0}, 1)};
  for (const std::size_t k : {0, 1}) s.solids[k].rigid.velocity = {1, 0, 0};
  for (const std::size_t k : {2, 3}) s.solids[k].kind = SolidKind::fixed;
  if (!both) s.solids.pop_back();
  s.joints = {test::hinge("elbow", "low", "high", {0.4, 0.51, 0})};
  set_restitution(s, 0.5, {"low", "peg"});
  if (both) set_restitution(s, 0.5, {"high", "other"});
  return s;
}

// Velocities along x and about z of both bars after impulses at heights `at` over their middles that make them part at
// half the speed at which they met, by the masses and the hinge.
Eigen::Vector4d bars_after(const std::vector<std::pair<int, double>>& at) {
  const double m = 1000 * 0.3 * 0.04, inertia = m * (0.3 * 0.3 + 0.04 * 0.04) / 12;
  const Eigen::Vector4d over_mass(1 / m, 1 / inertia, 1 / m, 1 / inertia), start(1, 0, 1, 0);
  const Eigen::Vector4d hinge(1, -0.15, -1, -0.15);  // rate of the gap along x; along y nothing moves
  Eigen::Matrix4d response = over_mass.asDiagonal();
  const Eigen::Vector4d back = response * hinge;
  response -= back * back.transpose() / hinge.dot(back);
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(4, Eigen::Index(at.size()));
  for (Eigen::Index i = 0; i < W.cols(); ++i) {
    const auto [bar, height] = at[std::size_t(i)];
    W(2 * bar, i) = -1, W(2 * bar + 1, i) = height;
  }
  const Eigen::VectorXd met = W.transpose() * start;
  return start - response * W * (W.transpose() * response * W).ldlt().solve(1.5 * met);
}

}  // namespace

// Measured, 6 ms after the impact: within 1.3 % with one peg, 0.8 % with two.
TEST_CASE("hinged bars part from pegs as their masses and the hinge have it", "[restitution]") {
  for (const bool both : {false, true}) {
    const Eigen::Vector4d wanted = both ? bars_after({{0, -0.1}, {1, -0.04}}) : bars_after({{0, -0.1}});
    const auto sim = make_simulation(hinged_bars(both), Communicator());
    const double energy = sim->stats().kinetic_energy;
    Eigen::Vector4d after = Eigen::Vector4d::Zero();
    while (sim->time() < 0.05) {  // they meet after 0.04 s
      CHECK(sim->step(0.05).kinetic_energy < 1.0001 * energy);
      const auto solids = sim->solids();
      after << solids[0].velocity[0], solids[0].angular_velocity[2], solids[1].velocity[0],
          solids[1].angular_velocity[2];
    }
    WARN((both ? "two pegs: " : "one peg: ") << after.transpose() << ", by theory " << wanted.transpose());
    for (const int i : {0, 2}) CHECK(after[i] == Approx(wanted[i]).margin(0.02));
    for (const int i : {1, 3}) CHECK(after[i] == Approx(wanted[i]).margin(0.1));
  }
}

}  // namespace restitution_joints_tests
