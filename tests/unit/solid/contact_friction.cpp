// Coulomb friction against closed forms (validation/README.md 6.11), in 2D and 3D.
#include "linalg/core/symmetric_eigen.h"
#include "solid/contact/friction.h"
#include "solid/contact/friction_updates.h"
#include "unit/solid/contact_cases.h"

namespace contact_friction_tests {
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

// A tower of five boxes, each pushed by another speed: some rub, some come to stick within the step. Newton's method
// does not feel how far the creep speed lies below these speeds.
TEMPLATE_TEST_CASE_SIG("sticking and slipping are found in few iterations, however low the creep speed", "",
                       ((int Dim), Dim), 2, 3) {
  const auto iterations = [](double creep_speed) {
    DryWorld<Dim> world;
    world.gravity = -g * Vec3::UnitY();
    world.walls = {{Vec3::Zero(), Vec3::UnitY()}};
    world.options.creep_speed = creep_speed;
    for (int i = 0; i < 5; ++i) {
      auto& b = world.add_box(Vec3(0.1, 0.1, Dim == 2 ? 1e-9 : 0.1), Vec3(0.004 * i, 0.0506 + 0.1006 * i, 0), 1000);
      b.contact.friction = 0.4;
    }
    for (int i = 0; i < 20; ++i) world.step(0.01);  // comes to rest
    for (int i = 0; i < 5; ++i) world.bodies[std::size_t(i)].velocity[0] = 0.6 * std::sin(2.0 * i);
    world.newton_iterations = 0;
    for (int i = 0; i < 10; ++i) {
      world.step(0.01);
      REQUIRE(world.report.failure.empty());
      CHECK(world.report.friction != FrictionState::unsettled);
    }
    return world.newton_iterations / 10.;
  };
  const double coarse = iterations(1e-2), fine = iterations(1e-4), finest = iterations(1e-6);
  WARN(Dim << "D: " << coarse << ", " << fine << ", " << finest << " iterations a step at 1e-2, 1e-4, 1e-6 m/s");
  CHECK(fine < 20);
  CHECK(finest < 25);
}

// w = u/eta gives the exact Hessian; any other w of at most unit length a positive semi-definite one, and Newton's step
// by du = 0 leads back to u/eta.
TEST_CASE("the friction of a pair has a Hessian that is exact where force and slip agree") {
  using Slip = Eigen::Vector2d;
  contact::FrictionPoint<3> f{};
  f.bound = 2;
  for (double speed : {0.03, 0.09, 0.5}) {
    const Slip u = speed * Slip(0.6, 0.8);
    f.direction = contact::next_direction<3>(f, u, Slip::Zero(), 0.1);
    CHECK(f.direction.norm() <= 1);
    const auto gradient = [&](const Slip& at) { return contact::slip_energy<3>(f, at, 0.1).gradient; };
    const double h = 1e-6;
    Eigen::Matrix2d differences;
    for (int i = 0; i < 2; ++i)
      differences.col(i) = (gradient(u + h * Slip::Unit(i)) - gradient(u - h * Slip::Unit(i))) / (2 * h);
    const Eigen::Matrix2d exact = contact::slip_energy<3>(f, u, 0.1).hessian;
    CHECK((exact - differences).norm() < 1e-7 * exact.norm());  // round-off of differences over 1e-6
    CHECK((contact::next_direction<3>(f, u, Slip::Zero(), 0.1) - f.direction).norm() < 1e-14);
    for (double angle = 0; angle < 6.3; angle += 0.1) {
      f.direction = Slip(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d values = symmetric_eigenvalues(contact::slip_energy<3>(f, u, 0.1).hessian);
      CHECK(values[0] > -1e-15 * values[1]);
    }
  }
}

// b = 1 is the fixed point of G(b) = 1 + g (b - 1). Plain updates turn for ever at g = -1 and diverge below.
TEST_CASE("relaxed updates of bounds find the fixed point of steep maps", "[contact]") {
  for (const double g : {-5.0, -1.0, -0.5, 0.0, 0.3}) {
    contact::Relaxation relaxation;
    double b = 0;
    int updates = 0;
    for (; updates < 20 && std::abs(b - 1) > 1e-9; ++updates) {
      const double change = (g - 1) * (b - 1);
      b += relaxation.next({{{0, 1, 2, 3, 4}, change}}) * change;
    }
    INFO(g);
    CHECK(updates <= (g > 0 ? 18 : 5));  // a share of 1 at most, so 0.3^n beyond
  }
}

TEST_CASE("relaxed updates of bounds recover after noise", "[contact]") {
  contact::Relaxation relaxation;
  const auto share = [&](double change) { return relaxation.next({{{0, 0, 0, 0, 0}, change}}); };
  CHECK(share(1) == 0.5);
  CHECK(share(4) == 0.25);  // grew: less is taken
  CHECK(share(8) == 0.125);
  CHECK(share(7) == 0.5);  // shrank by an eighth, as where G is constant: the line asks for 1, twice the most is taken
  CHECK(share(3.5) == 1);
}

}  // namespace contact_friction_tests
