// Coulomb friction against closed forms (validation/README.md 6.11), in 2D and 3D.
#include "unit/solid/contact_cases.h"

using namespace seiche;
using namespace seiche::contact_cases;

namespace {

constexpr double degree = 3.14159265358979323846 / 180, g = 9.81;

// A box of side 0.1 m at rest just above a floor y = 0; gravity is rotated by the angle given.
template <int Dim>
DryWorld<Dim> box_on_slope(double angle, double friction) {
  DryWorld<Dim> world;
  world.gravity = g * Vec3(std::sin(angle), -std::cos(angle), 0);
  world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
  const Vec3 sides = 0.1 * Vec3(1, 1, Dim == 3);
  world.add_box(sides + (Dim == 2 ? Vec3(0, 0, 1e-9) : Vec3(0, 0, 0)), Vec3(0, 0.0508, 0), 1000).contact.friction =
      friction;
  return world;
}

// Mean acceleration over one second, after half a second in which the box comes to rest on the floor.
template <int Dim>
double acceleration(double angle, double friction) {
  DryWorld<Dim> world = box_on_slope<Dim>(angle, friction);
  const double dt = 0.01;
  for (int i = 0; i < 50; ++i) world.step(dt);
  const double before = world.bodies[0].velocity[0];
  for (int i = 0; i < 100; ++i) world.step(dt);
  return world.bodies[0].velocity[0] - before;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a box slides down an incline as Coulomb says", "", ((int Dim), Dim), 2, 3) {
  for (double mu : {0.1, 0.3, 0.5}) {
    const double expected = g * (std::sin(30 * degree) - mu * std::cos(30 * degree));
    CHECK(acceleration<Dim>(30 * degree, mu) == Approx(expected).epsilon(0.01));
  }
}

TEMPLATE_TEST_CASE_SIG("a box sticks above the angle of friction and slides below", "", ((int Dim), Dim), 2, 3) {
  const double tangent = std::tan(30 * degree);
  DryWorld<Dim> sticking = box_on_slope<Dim>(30 * degree, 1.02 * tangent);
  for (int i = 0; i < 1000; ++i) sticking.step(0.01);
  CHECK(std::abs(sticking.bodies[0].pose.displacement[0]) < 0.01 * 0.1);  // 1 % of its size in 10 s
  CHECK(acceleration<Dim>(30 * degree, 0.98 * tangent) == Approx(0.02 * g * std::sin(30 * degree)).epsilon(0.02));
}

TEMPLATE_TEST_CASE_SIG("a sliding box stops after v^2/(2 mu g)", "", ((int Dim), Dim), 2, 3) {
  const double mu = 0.3, v = 1, dt = 0.002;
  DryWorld<Dim> world = box_on_slope<Dim>(0, mu);
  for (int i = 0; i < 100; ++i) world.step(dt);  // comes to rest on the floor
  const double start = world.bodies[0].pose.displacement[0];
  world.bodies[0].velocity[0] = v;
  for (int i = 0; i < 300; ++i) world.step(dt);
  // The implicit step stops v dt/2 early, which is no error of friction.
  const double way = world.bodies[0].pose.displacement[0] - start + 0.5 * v * dt;
  CHECK(way == Approx(v * v / (2 * mu * g)).epsilon(0.01));
  CHECK(std::abs(world.bodies[0].velocity[0]) < world.options.creep_speed);
}
