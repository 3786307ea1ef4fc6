// Stacks that stand: equal masses, and the heaviest on top.
#include "solid_contact_cases.h"

using namespace seiche;
using namespace seiche::contact_cases;

namespace {

constexpr double side = 0.1;

// Ten boxes on the floor with the masses of a geometric series from bottom to top.
template <int Dim>
DryWorld<Dim> stack(double top_over_bottom) {
  DryWorld<Dim> world;
  world.gravity = Vec3(0, -9.81, 0);
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  for (int i = 0; i < 10; ++i) {
    const double gap = 0.8 * world.options.reach;
    const Vec3 center(0, 0.5 * side + gap + i * (side + gap), 0);
    world.add_box(Vec3::Constant(side), center, 1000 * std::pow(top_over_bottom, i / 9.)).contact.friction = 0.5;
  }
  return world;
}

template <int Dim>
void check_that_it_stands(double top_over_bottom, double seconds) {
  DryWorld<Dim> world = stack<Dim>(top_over_bottom);
  const double dt = 0.01;
  std::vector<Vec3> settled;
  double smallest_gap = world.options.reach;
  for (int i = 0; i < seconds / dt; ++i) {
    world.step(dt);
    if (i >= 50) smallest_gap = std::min(smallest_gap, world.report.smallest_gap);
    if (i == 50)
      for (const auto& b : world.bodies) settled.push_back(b.pose.displacement);
  }
  double creep = 0, speed = 0, turn = 0;
  for (size_t b = 0; b < settled.size(); ++b) {
    creep = std::max(creep, (world.bodies[b].pose.displacement - settled[b]).norm());
    speed = std::max(speed, world.bodies[b].velocity.template head<Dim>().norm());
    turn = std::max(turn, (world.bodies[b].pose.rotation - Eigen::Matrix3d::Identity()).norm());
  }
  CAPTURE(Dim, top_over_bottom, creep, speed, turn, smallest_gap, world.report.stiffness);
  CAPTURE(double(world.newton_iterations) * dt / seconds, double(world.solves) * dt / seconds);
  CHECK(creep < 0.01 * side);
  CHECK(turn < 0.01);
  CHECK(speed < world.options.creep_speed);
  CHECK(smallest_gap > 0.01 * world.options.reach);
}

}  // namespace

TEST_CASE("ten boxes stand for ten seconds, 2D") {
  check_that_it_stands<2>(1, 10);
  check_that_it_stands<2>(1e4, 10);
}

TEST_CASE("ten boxes stand, 3D") {
  check_that_it_stands<3>(1, 3);
  check_that_it_stands<3>(1e4, 10);
}
