// Sticking and sliding elastic blocks.
#include "unit/solid/soft_cases.h"

namespace soft_friction_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

constexpr double g = 9.81;

// A block of 0.1 m on a plane, with gravity tilted by `degrees`, at rest except for a speed along x.
template <int Dim>
SoftWorld<Dim> block_on_plane(double mu, double degrees, double speed) {
  const double angle = degrees * 3.14159265358979323846 / 180;
  SoftWorld<Dim> world;
  world.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  world.options.reach = 1e-4;
  auto& s = world.add(box_mesh<Dim>(Vec<Dim>::Unit(1) * 7e-5, Vec<Dim>::Constant(0.1) + Vec<Dim>::Unit(1) * 7e-5,
                                    IVec<Dim>::Constant(2), Dim == 2 ? 2 : 1),
                      1000, 1e6, 0.3);
  s.friction = mu;
  for (int i = 0; i < s.body.size(); i += Dim) s.state.v[i] = speed;
  return world;
}

// Velocity of the centre of mass along x.
template <int Dim>
double mean(const SoftWorld<Dim>& world, const Eigen::VectorXd& field) {
  const auto& s = world.soft[0];
  double sum = 0;
  for (int i = 0; i < s.body.size(); i += Dim) sum += s.body.lumped_mass[i] * field[i];
  return sum / world.mass(s);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("an elastic block on an incline of 30 degrees slides as Coulomb says", "[soft]",
                       ((int Dim), Dim), 2, 3) {
  const double dt = 0.01, angle = 30 * 3.14159265358979323846 / 180;
  for (double mu : {0.1, 0.3, 0.5}) {
    auto world = block_on_plane<Dim>(mu, 30, 0);
    for (int n = 0; n < 10; ++n) world.step(dt);  // until it has come to rest
    const double before = mean(world, world.soft[0].state.v);
    for (int n = 0; n < 30; ++n) world.step(dt);
    const double a = (mean(world, world.soft[0].state.v) - before) / (30 * dt);
    const double exact = g * (std::sin(angle) - mu * std::cos(angle));
    WARN(Dim << "D, mu " << mu << ": " << a << " m/s^2 for " << exact << ", " << world.newton_iterations / 40.
             << " iterations a step");
    CHECK(a == Approx(exact).epsilon(0.01));
  }
}

TEMPLATE_TEST_CASE_SIG("an elastic block sticks just below the angle of friction and slides just above", "[soft]",
                       ((int Dim), Dim), 2, 3) {
  const double slope = std::tan(30 * 3.14159265358979323846 / 180);
  auto sticks = block_on_plane<Dim>(1.02 * slope, 30, 0), slides = block_on_plane<Dim>(0.98 * slope, 30, 0);
  for (int n = 0; n < 100; ++n) sticks.step(0.01);
  for (int n = 0; n < 100; ++n) slides.step(0.01);
  WARN(Dim << "D: sticks, " << mean(sticks, sticks.soft[0].state.u) << " m; slides, "
           << mean(slides, slides.soft[0].state.u) << " m in 1 s");
  CHECK(std::abs(mean(sticks, sticks.soft[0].state.v)) < sticks.options.creep_speed);
  CHECK(std::abs(mean(sticks, sticks.soft[0].state.u)) < 1e-3);
  CHECK(mean(slides, slides.soft[0].state.u) > 0.02);
}

TEMPLATE_TEST_CASE_SIG("an elastic block that slides on a plane stops where Coulomb says", "[soft]", ((int Dim), Dim),
                       2, 3) {
  const double mu = 0.4, speed = 2, dt = 0.005;
  auto world = block_on_plane<Dim>(mu, 0, speed);
  for (int n = 0; n < 140; ++n) world.step(dt);
  const double way = mean(world, world.soft[0].state.u);
  const double exact = speed * speed / (2 * mu * g) - 0.5 * speed * dt;  // minus the error of the implicit step
  WARN(Dim << "D: stops after " << way << " m for " << exact << ", " << world.newton_iterations / 140.
           << " iterations a step");
  CHECK(way == Approx(exact).epsilon(0.02));
  CHECK(std::abs(mean(world, world.soft[0].state.v)) < 1e-3);
}

}  // namespace soft_friction_tests
