// Solids on a spring, in vacuum and in liquid. The kind `sprung` takes one file and one row in the table of kinds.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "coupling/solids/solid_kinds.h"
#include "scenes.h"

namespace sprung_tests {
using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

SolidKind kind_named(const std::string& name) {
  for (const SolidKindRow& row : solid_kinds())
    if (row.kind.name == name) return row.kind;
  FAIL("no kind " << name);
  return {};
}

// A disc (3D: ball) on a spring to the middle of the box.
Scene scene_of(int dim, int cells, double radius, double density, double stiffness, const Vec3& velocity) {
  Scene s = test::box_scene(dim, cells);
  SolidSpec disc;
  disc.name = "disc";
  disc.kind = kind_named("sprung");
  disc.shape.kind = "sphere";
  disc.shape.center = {0.5, 0.5, dim == 3 ? 0.5 : 0.0};
  disc.shape.radius = radius;
  disc.rigid.density = density;
  disc.rigid.velocity = velocity;
  disc.numbers["spring_stiffness"] = stiffness;
  s.solids.push_back(disc);
  return s;
}

// Rotation of (omega x, v) in a step of the implicit midpoint rule: theta with tan(theta/2) = omega dt/2.
double turn_of_step(double omega, double dt) {
  return 2 * std::atan(omega * dt / 2);
}

template <int Dim>
void check_alone() {
  const double radius = 0.1, volume = Dim == 2 ? pi * radius * radius : 4 * pi / 3 * std::pow(radius, 3);
  const double mass = 500 * volume, omega = 10, speed = 0.3;
  Scene s = scene_of(Dim, 12, radius, 500, mass * omega * omega, {speed, -speed / 2, 0});
  double coarse = 0;
  for (const double dt : {0.02, 0.01}) {
    s.time.fixed_step = dt;
    const auto sim = make_simulation(s, Communicator());
    const double energy = 0.5 * mass * (speed * speed * 1.25);
    double error = 0;
    for (int n = 1; n * dt < 1 - 1e-9; ++n) {
      const StepStats stats = sim->step(1);
      const Vec3 way = sim->solids()[0].position - s.solids[0].shape.center;
      const double by_rule = speed / omega * std::sin(n * turn_of_step(omega, dt));
      REQUIRE(way[0] == Approx(by_rule).margin(1e-12));  // round-off of positions of size 1 over some steps
      REQUIRE(way[1] == Approx(-by_rule / 2).margin(1e-12));
      error = std::max(error, std::abs(way[0] - speed / omega * std::sin(omega * n * dt)));
      REQUIRE(stats.kinetic_energy + stats.elastic_energy == Approx(energy).epsilon(1e-12));  // conserved
    }
    WARN(Dim << "D, dt = " << dt << " s: off the exact oscillation by " << error << " m of " << speed / omega);
    if (dt == 0.01) CHECK(test::order(coarse, error) > 1.9);
    coarse = error;
  }
}

// Half a period: from the first passage through the middle to the second, by linear interpolation between steps. The
// start does not count: in the first step, which advances with the initial velocity, the liquid at rest takes up its
// part of the momentum.
double half_period(Scene s, double dt) {
  s.time.fixed_step = dt;
  s.time.end = 100;
  s.time.frame_rate = 0.01;
  const auto sim = make_simulation(s, Communicator());
  std::vector<double> through;
  double before = 0;
  for (int n = 1; n < 400 && through.size() < 2; ++n) {
    (void)sim->step(100);
    const double x = sim->solids()[0].position[0] - 0.5;
    if (n > 1 && (x < 0) != (before < 0)) through.push_back(sim->time() - dt * x / (x - before));
    before = x;
  }
  REQUIRE(through.size() == 2);
  return through[1] - through[0];
}

}  // namespace

TEST_CASE("a body on a spring swings as the midpoint rule does, which is of second order") {
  check_alone<2>();
  check_alone<3>();
}

// Liquid between a disc of radius a and a surrounding cylinder of radius b adds the mass rho pi a^2 (b^2 + a^2)/(b^2 -
// a^2) for small oscillations (Lamb, Hydrodynamics, 93): omega^2 = k/(m + m_a).
TEST_CASE("a disc on a spring swings slower in liquid by the added mass") {
  const double a = 0.2, b = 0.45, rho = 1000, density = 500, k = 4000, amplitude = 1e-3;
  const double mass = density * pi * a * a, added = rho * pi * a * a * (b * b + a * a) / (b * b - a * a);
  const double omega = std::sqrt(k / (mass + added));
  double coarse = 0;
  for (const int cells : {16, 32, 64}) {
    Scene s = scene_of(2, cells, a, density, k, {amplitude * omega, 0, 0});
    test::add_liquid(s, "-1");
    SolidSpec vessel;
    vessel.name = "vessel";
    vessel.shape.kind = "sphere";
    vessel.shape.center = {0.5, 0.5, 0};
    vessel.shape.radius = b;
    vessel.shape.invert = true;
    s.solids.push_back(vessel);
    const double found = pi / half_period(s, 0.02 * pi / omega);
    const double error = std::abs(found / omega - 1);
    WARN(cells << " cells: omega " << found << " 1/s, exact " << omega << ", in vacuum " << std::sqrt(k / mass)
               << ", off by " << error);
    if (cells == 64) CHECK(error < 0.003);  // measured: 0.0006, half of it by the midpoint rule
    if (cells == 64) CHECK(test::order(coarse, error) > 0.9);
    coarse = error;
  }
}

// A spring of a period far below the time of a frame. The first step advances with the initial velocity; in one of a
// frame's length the spring would store a thousand times the energy there is. Found by the fuzzer.
TEMPLATE_TEST_CASE_SIG("a stiff spring starts without energy from nowhere", "", ((int Dim), Dim), 2, 3) {
  const double speed = 0.3;
  Scene s = scene_of(Dim, 12, 0.1, 500, 1e6, {speed, 0, 0});
  const auto sim = make_simulation(s, Communicator());
  const double start = sim->stats().kinetic_energy;
  for (int n = 0; n < 5; ++n) {
    const StepStats stats = sim->step(1);
    CHECK(stats.kinetic_energy + stats.elastic_energy <= start * (1 + 2e-3));  // a thousandth in the first step
  }
}

// A run resumed from a checkpoint gives the same bits.
TEST_CASE("a body on a spring goes on from a checkpoint with the same bits") {
  Scene s = scene_of(2, 16, 0.2, 500, 4000, {0.1, 0, 0});
  test::add_liquid(s, "y-0.7");
  s.gravity = {0, -9.81, 0};
  const auto whole = make_simulation(s, Communicator());
  for (int n = 0; n < 10; ++n) {
    const auto other = make_simulation(s, Communicator());
    other->load(whole->save());
    (void)whole->step(1);
    (void)other->step(1);
    REQUIRE(whole->solids()[0].position == other->solids()[0].position);
    REQUIRE(whole->solids()[0].velocity == other->solids()[0].velocity);
  }
}

}  // namespace sprung_tests
