// Stacks at rest: equal masses, and the heaviest on top.
#include "unit/solid/contact_cases.h"

namespace contact_stack_tests {
using namespace seiche;
using namespace seiche::contact_cases;

namespace {

constexpr double side = 0.1;

// Ten boxes on the floor; their masses form a geometric series from bottom to top.
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

TEST_CASE("ten boxes stand, 3D", "[long]") {
  check_that_it_stands<3>(1, 3);
  check_that_it_stands<3>(1e4, 10);
}

TEST_CASE("one heavy box stands on nine that weigh a ten-thousandth, 2D") {
  DryWorld<2> world = stack<2>(1);
  world.bodies[9].contact.mass *= 1e4;
  world.bodies[9].inertia *= 1e4;
  for (int i = 0; i < 50; ++i) world.step(0.01);
  const double height = world.bodies[9].pose.displacement[1];
  for (int i = 0; i < 300; ++i) world.step(0.01);
  CHECK(std::abs(world.bodies[9].pose.displacement[1] - height) < 0.01 * side);
  CHECK(world.report.smallest_gap > 0.1 * world.options.reach);
}

TEST_CASE("bodies without liquid: the minimum, its gradient and what is held") {
  Eigen::SparseMatrix<double> mass(3, 3), K(3, 3);
  for (int i = 0; i < 3; ++i) mass.insert(i, i) = i + 1;
  K.insert(0, 0) = 2;
  K.insert(0, 2) = K.insert(2, 0) = -1;
  K.insert(2, 2) = 3;
  const Eigen::Vector3d target(1, 2, 3), r(0.5, 0, -1);
  DryProblem problem(mass, target, {Freedom::free, Freedom::fixed, Freedom::free});
  const InertiaResponse response = problem.minimise(K, r);
  const Eigen::VectorXd residual = response.gradient + K * response.velocity - r;
  CHECK(response.velocity[1] == 0);
  CHECK(std::abs(residual[0]) < 1e-14);
  CHECK(std::abs(residual[2]) < 1e-14);
  CHECK(response.gradient[1] == Approx(-4));  // the reaction
  K.coeffRef(2, 2) = -10;
  CHECK(problem.minimise(K, r).shape == Shape::indefinite);
}

}  // namespace contact_stack_tests
