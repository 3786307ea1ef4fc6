// Jointed bodies without liquid, against solutions that others found.
#include <catch2/catch.hpp>

#include "coupling/state/attempt.h"
#include "coupling/step/initial_state.h"
#include "coupling/step/step.h"
#include "joint_scenes.h"

namespace joints_tests {
using namespace seiche;
using test::bar_like, test::energy_of, test::hinge, test::joint, test::pi;

namespace {

// A bar on a hinge, let go at rest at an angle from hanging down.
Scene pendulum(double degrees) {
  Scene s = test::swing_scene(2, 1.6, 0.16);
  const double a = degrees * pi / 180;
  s.solids = {bar_like("bar", {0, 0, 0}, {std::sin(a), -std::cos(a), 0}, 1, 0.2)};
  s.joints = {hinge("pin", "bar", "world", {0, 0, 0})};
  return s;
}

double period_of(Scene s, double expected, int steps) {
  s.time.fixed_step = expected / steps;
  s.time.frame_rate = 0.5 / expected;
  test::Crossings through;
  double from_vertical = 0;
  test::run_steps(s, 1.4 * expected, [&](const Simulation& sim) {
    const Vec3 x = sim.solids()[0].position;
    from_vertical = std::atan2(x[0], -x[1]);
    through.add(sim.time(), from_vertical);
    CHECK(sim.stats().joint_gap <= 1e-9);
  });
  REQUIRE(through.times.size() >= 2);
  return 2 * (through.times[1] - through.times[0]);
}

// Linear momentum, and angular momentum about the origin, of bodies on their straight ways.
template <int Dim>
std::array<Vec3, 2> momenta(const State<Dim>& state) {
  std::array<Vec3, 2> sum{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t k = 0; k < state.solids.size(); ++k) {
    const RigidState r = not_shown(*state.solids[k].rigid());
    const Vec3 p = state.solids[k].body().mass().mass * r.velocity;
    sum[0] += p;
    sum[1] += r.center.cross(p) + r.angular_momentum;
  }
  return sum;
}

template <int Dim>
void check_momenta(const Scene& s) {
  const Setup<Dim> setup(s, Communicator());
  State<Dim> state = initial_state(setup);
  Phases phases;
  const std::array<Vec3, 2> start = momenta(state);
  double worst = 0;
  for (int n = 0; n < 30; ++n) {
    Attempt<Dim> attempt = attempt_step(setup, state, 0.01, phases);
    REQUIRE(attempt.failure.empty());
    state = std::move(attempt.state);
    const std::array<Vec3, 2> now = momenta(state);
    worst = std::max({worst, (now[0] - start[0]).norm(), (now[1] - start[1]).norm()});
  }
  // 1e-12 of the momenta, up to 1 kg m^2/s; round-off of steps adds up.
  WARN("momenta within " << worst);
  CHECK(worst <= 1e-12);
}

}  // namespace

// T/T_0 = 2 K(sin(a/2))/pi. Without the bow of its path the period is short by (omega dt)^2/24 for small angles.
TEST_CASE("joints: periods of a pendulum are those of the elliptic integral, to second order", "[joints]") {
  const double small = 2 * pi * std::sqrt(2 / (3 * 9.81));
  for (const auto& [degrees, ratio] : {std::pair(30.0, 1.0174088), {90.0, 1.1803406}, {170.0, 2.4393627}}) {
    const double exact = small * ratio;
    const int steps = degrees > 90 ? 200 : 100;  // its tip goes at most a cell a step
    const double coarse = period_of(pendulum(degrees), exact, steps) / exact - 1,
                 fine = period_of(pendulum(degrees), exact, 2 * steps) / exact - 1;
    WARN(degrees << " degrees: period off by " << coarse << ", " << fine);
    CHECK(std::abs(coarse) <= 1e-4);  // measured: 5.7e-6, 5.2e-5, 6.2e-5
    CHECK(test::order(coarse, fine) == Approx(2).margin(0.1));
  }
}

// The same pendulum without gravity, pulled down by a field, or by a load at its tip: half its weight at twice the
// distance of its centre.
TEST_CASE("joints: fields and loads swing a pendulum as gravity does", "[joints]") {
  const double exact = 2 * pi * std::sqrt(2 / (3 * 9.81)) * 1.0174088, a = 30 * pi / 180;
  for (const ForceKind kind : {ForceKind::acceleration, ForceKind::load}) {
    Scene s = pendulum(30);
    s.gravity = Vec3(0, 0, 0);
    ForceSpec& force = s.forces.emplace_back();
    force.kind = kind;
    if (kind == ForceKind::acceleration) force.acceleration = {"0", "-9.81", "0"};
    if (kind == ForceKind::load) {
      force.solids = {"bar"};
      force.force = {"0", "-0.5*9.81", "0"};
      force.at = Vec3(std::sin(a), -std::cos(a), 0);
    }
    const double off = period_of(s, exact, 100) / exact - 1;
    WARN((kind == ForceKind::load ? "load" : "field") << ": period off by " << off);
    CHECK(std::abs(off) <= 1e-5);  // measured: 5.7e-6 both; -1.5e-4 without their part of the bow
  }
}

// Reference angles of both bars from the vertical to 1e-8, by an adaptive method of high order.
TEST_CASE("joints: a double pendulum follows its reference to second order and keeps its energy", "[joints]") {
  Scene s = test::double_pendulum();
  s.time.frame_rate = 2;
  const std::array<std::array<double, 2>, 3> exact{
      {{0.44814263, 1.04196289}, {-1.20771624, -0.81439102}, {-1.15032568, -2.09912613}}};
  std::array<double, 2> error{}, energy{};
  for (const int level : {0, 1}) {
    s.time.fixed_step = level == 0 ? 0.01 : 0.005;
    double start = 0;
    test::run_steps(s, 1.5, [&](const Simulation& sim) {
      if (sim.step_count() == 0) start = energy_of(sim.stats());
      energy[level] = std::max(energy[level], std::abs(energy_of(sim.stats()) - start));
      CHECK(sim.stats().joint_gap <= 1e-9);
      const double halves = sim.time() / 0.5;
      if (halves < 0.5 || std::abs(halves - std::round(halves)) > 1e-9) return;
      for (int k = 0; k < 2; ++k) {
        const double angle = test::degrees_about_z(sim.solids()[k]) * pi / 180 + pi / 2;
        error[level] =
            std::max(error[level], std::abs(std::remainder(angle - exact[int(halves + 0.5) - 1][k], 2 * pi)));
      }
    });
  }
  WARN("angles off by " << error[0] << ", " << error[1] << "; energy by " << energy[0] << ", " << energy[1]
                        << " of 19.6 J");
  CHECK(error[0] <= 1e-4);   // 4.4e-5
  CHECK(energy[0] <= 0.01);  // 0.0041 J; the bar at 5 ms is 0.5 %, 0.1 J
  CHECK(test::order(error[0], error[1]) == Approx(2).margin(0.1));
  CHECK(test::order(energy[0], energy[1]) == Approx(2).margin(0.1));
}

// Two bodies that hold each other by any joint, thrown without gravity.
TEST_CASE("joints: jointed bodies in flight keep their momenta", "[joints]") {
  for (const int dim : {2, 3})
    for (const JointKind kind : {JointKind::weld, JointKind::hinge, JointKind::ball, JointKind::slider,
                                 JointKind::universal, JointKind::distance}) {
      if (dim == 2 && (kind == JointKind::ball || kind == JointKind::universal)) continue;
      Scene s = test::swing_scene(dim, 1, 0.1, 0);
      s.solids = {test::rigid_box("a", {0.3, 0.2, 0.25}, {-0.2, 0, 0}, 500),
                  test::rigid_box("b", {0.3, 0.2, 0.15}, {0.2, 0, 0}, 100)};
      s.solids[0].rigid.angular_velocity = dim == 3 ? Vec3(1, -2, 3) : Vec3(0, 0, 3);
      s.joints = {joint("j", kind, "a", "b", {0.02, 0.03, 0})};
      if (dim == 3 || kind == JointKind::slider) s.joints[0].axis = Vec3(1, 0, 0);
      if (dim == 3 && kind == JointKind::hinge) s.joints[0].axis = Vec3(0, 0.6, 0.8);
      s.joints[0].second = Vec3(0, 1, 0);
      s.joints[0].to = Vec3(0.3, 0.05, 0);
      s.time.fixed_step = 0.01;
      CAPTURE(dim, int(kind));
      if (dim == 2)
        check_momenta<2>(s);
      else
        check_momenta<3>(s);
    }
}

// x = r cos(theta) + sqrt(l^2 - r^2 sin^2(theta)) of the slide, with the crank driven.
TEST_CASE("joints: a driven slider-crank is where its triangle puts it", "[joints]") {
  Scene s = test::swing_scene(2, 1, 0.1, 0);
  const double r = 0.3, l = 0.5;
  s.solids = {bar_like("crank", {0, 0, 0}, {r, 0, 0}, 1, 0.12), bar_like("rod", {r, 0, 0}, {r + l, 0, 0}, 1, 0.12),
              test::rigid_box("block", {0.12, 0.12, 0}, {r + l, 0, 0}, 100)};
  s.joints = {hinge("axle", "crank", "world", {0, 0, 0}), hinge("big end", "rod", "crank", {r, 0, 0}),
              hinge("small end", "block", "rod", {r + l, 0, 0}),
              joint("slide", JointKind::slider, "block", "world", {r + l, 0, 0})};
  s.joints[3].axis = Vec3(1, 0, 0);
  s.joints[0].drive.emplace();
  s.joints[0].drive->degrees = "360*t";
  s.time.fixed_step = 0.01;
  test::run_steps(s, 1.2, [&](const Simulation& sim) {
    const double angle = 2 * pi * sim.time();
    const Vec3 x = sim.solids()[2].position;
    CHECK(x[0] == Approx(r * std::cos(angle) + std::sqrt(l * l - std::pow(r * std::sin(angle), 2))).margin(1e-9));
    CHECK(std::abs(x[1]) <= 1e-9);
    CHECK(sim.joints()[0].q == Approx(angle).margin(1e-9));  // beyond a turn, too
  });
}

// Crank 0.15, coupler 0.45, rocker 0.35, ground 0.4: the rocker stands where both circles meet (Freudenstein).
TEST_CASE("joints: a driven four-bar is where its circles meet", "[joints]") {
  const double a = 0.15, b = 0.45, c = 0.35, d = 0.4, start = 0.4;
  const Vec3 A(-0.2, 0, 0), D = A + Vec3(d, 0, 0);
  const auto crank_end = [&](double angle) { return Vec3(A + a * Vec3(std::cos(angle), std::sin(angle), 0)); };
  const auto rocker_end = [&](const Vec3& B) {
    const Vec3 way = D - B;
    const double far = way.norm(), along = (b * b - c * c + far * far) / (2 * far);
    return Vec3(B + along / far * way + std::sqrt(b * b - along * along) / far * Vec3(-way[1], way[0], 0));
  };
  const Vec3 B = crank_end(start), C = rocker_end(B);
  Scene s = test::swing_scene(2, 1, 0.05, 0);
  s.solids = {bar_like("crank", A, B, 1, 0.06), bar_like("coupler", B, C, 1, 0.06), bar_like("rocker", C, D, 1, 0.06)};
  s.joints = {hinge("axle", "crank", "world", A), hinge("one", "coupler", "crank", B),
              hinge("two", "rocker", "coupler", C), hinge("foot", "rocker", "world", D)};
  s.joints[0].drive.emplace();
  s.joints[0].drive->degrees = "360*t";
  s.time.fixed_step = 0.005;
  test::run_steps(s, 1.1, [&](const Simulation& sim) {
    const Vec3 end = rocker_end(crank_end(start + 2 * pi * sim.time()));
    CHECK((sim.solids()[2].position - 0.5 * (end + D)).norm() <= 1e-9);  // measured: 1e-11
  });
}

// A chain of twenty links between two points as far apart as 0.8 of its length, braked by its hinges until it hangs
// still: y = a (cosh(x/a) - 1), 2 a sinh(d/(2 a)) = L for the distance d and the length L.
TEST_CASE("joints: a chain hangs as a catenary", "[joints][long]") {
  constexpr int links = 20;
  const double length = 2, d = 1.6;
  Scene s = test::swing_scene(2, 1.2, 0.06);
  // It starts as a triangle.
  const double drop = std::sqrt(0.25 * (length * length - d * d)), link = length / links;
  const auto place = [&](int n) {
    const double way = n * link;
    const bool down = 2 * n <= links;
    const double along = down ? way : length - way;
    return Vec3((down ? 1 : -1) * (along / (length / 2) - 1) * d / 2, 0.5 - along / (length / 2) * drop, 0);
  };
  for (int n = 0; n < links; ++n) {
    s.solids.push_back(bar_like(fmt::format("link{}", n), place(n), place(n + 1), 0.1, 0.07));
    s.joints.push_back(hinge(fmt::format("pin{}", n), fmt::format("link{}", n),
                             n == 0 ? "world" : fmt::format("link{}", n - 1), place(n)));
    s.joints.back().spring.emplace().damping = 0.02;
  }
  s.joints.push_back(hinge("end", fmt::format("link{}", links - 1), "world", place(links)));
  s.time.fixed_step = 0.01;
  double deepest = 0, moving = 1;
  test::run_steps(s, 30, [&](const Simulation& sim) {
    deepest = sim.solids()[links / 2].position[1];
    moving = sim.stats().kinetic_energy;
  });
  double a = 0.5;  // by bisection
  for (double low = 0.05, high = 20; high - low > 1e-12; a = 0.5 * (low + high))
    (2 * a * std::sinh(d / (2 * a)) > length ? low : high) = a;
  const double sag = a * (std::cosh(d / (2 * a)) - 1);
  WARN("sag " << 0.5 - deepest << " of " << sag << " m, with " << moving << " J");
  CHECK(moving <= 1e-6);
  CHECK(0.5 - deepest == Approx(sag).epsilon(0.01));
}

// Torsional spring: the midpoint rule of angle omega dt = 2 atan(omega dt/2), as for sprung solids.
TEST_CASE("joints: a spring in a hinge swings as the midpoint rule has it", "[joints]") {
  Scene s = test::swing_scene(2, 1.6, 0.16, 0);
  s.solids = {bar_like("bar", {0, 0, 0}, {1, 0, 0}, 1, 0.2)};
  s.joints = {hinge("pin", "bar", "world", {0, 0, 0})};
  JointSpringSpec& spring = s.joints[0].spring.emplace();
  const double omega = 10, dt = 0.02, amplitude = 0.2;
  spring.stiffness = omega * omega / 3;
  spring.rest = amplitude * 180 / pi;
  s.time.fixed_step = dt;
  double start = -1;
  test::run_steps(s, 1, [&](const Simulation& sim) {
    if (start < 0) start = energy_of(sim.stats());
    const double theta = 2 * std::atan(omega * dt / 2) / dt * sim.time();
    CHECK(sim.joints()[0].q == Approx(amplitude * (1 - std::cos(theta))).margin(1e-3 * amplitude));  // rod not chord
    CHECK(energy_of(sim.stats()) == Approx(start).epsilon(1e-2));
  });
}

// I dw/dt = torque, until it goes at the motor's speed. A load of twice its torque stalls it.
TEST_CASE("joints: a motor pulls with its torque, runs at its speed, and stalls", "[joints]") {
  Scene s = test::swing_scene(2, 1.6, 0.16, 0);
  s.solids = {bar_like("bar", {0, 0, 0}, {1, 0, 0}, 1, 0.2)};
  s.joints = {hinge("pin", "bar", "world", {0, 0, 0})};
  JointMotorSpec& motor = s.joints[0].motor.emplace();
  motor.speed = "2", motor.torque = 1;
  s.time.fixed_step = 0.01;
  test::run_steps(s, 1, [&](const Simulation& sim) {
    const double t = sim.time();
    if (sim.step_count() > 0 && t < 0.6) CHECK(sim.joints()[0].torque[2] == Approx(1).epsilon(1e-9));
    if (t < 0.6) CHECK(sim.joints()[0].rate == Approx(3 * t).epsilon(1e-4));  // (w dt)^2/8, of chords
    if (t > 0.7) CHECK(sim.joints()[0].rate == Approx(2).epsilon(1e-3));
  });
  // The bar's weight is 9.81 N at half a metre: 4.905 N m. It leans on a stop while the motor pulls in vain.
  s.gravity = Vec3(0, -9.81, 0);
  motor.torque = 2;
  s.joints[0].limits = {-5.0, 60.0};
  test::run_steps(s, 1, [&](const Simulation& sim) {
    CHECK(sim.joints()[0].q > -5 * pi / 180);
    if (sim.time() < 0.8) return;
    CHECK(std::abs(sim.joints()[0].rate) <= 1e-3);
    CHECK(sim.joints()[0].torque[2] == Approx(4.905 * std::cos(5 * pi / 180)).epsilon(1e-3));
  });
}

TEST_CASE("joints: a gear keeps two hinges in its ratio", "[joints]") {
  Scene s = test::swing_scene(2, 1, 0.1, 0);
  s.solids = {test::rigid_ball("small", 0.15, {-0.4, 0, 0}, 1000), test::rigid_ball("large", 0.3, {0.2, 0, 0}, 1000)};
  s.joints = {hinge("a", "small", "world", {-0.4, 0, 0}), hinge("b", "large", "world", {0.2, 0, 0}),
              joint("teeth", JointKind::gear, "a", "b", Vec3::Zero())};
  s.joints[2].ratio = -2;
  JointMotorSpec& motor = s.joints[0].motor.emplace();
  motor.speed = "20", motor.torque = 5;
  s.time.fixed_step = 0.01;
  test::run_steps(
      s, 1, [&](const Simulation& sim) { CHECK(sim.joints()[0].q == Approx(-2 * sim.joints()[1].q).margin(1e-9)); });
}

// A weight on a weld under gravity that grows: it falls freely from the step on in which the weld breaks.
TEST_CASE("joints: a joint bears its load exactly and breaks where that exceeds what it bears", "[joints]") {
  Scene s = test::swing_scene(2, 1, 0.1, 0);
  s.gravity.formula = {"0.0", "-10*t", "0.0"};
  s.solids = {test::rigid_box("weight", {0.4, 0.5, 0}, {0, 0.2, 0}, 10)};  // 2 kg
  s.joints = {joint("weld", JointKind::weld, "weight", "world", {0, 0.5, 0})};
  s.joints[0].breaks_at.emplace().force = 10;  // at half a second
  s.time.fixed_step = 0.01;
  double fell = 0;
  test::run_steps(s, 0.8, [&](const Simulation& sim) {
    const JointReport weld = sim.joints()[0];
    const double t = sim.time();
    CHECK(weld.broken == (t > 0.507));
    if (weld.broken) {
      if (fell == 0) fell = t - 0.01;
      CHECK(weld.force.norm() == 0);
      CHECK(sim.solids()[0].velocity[1] == Approx(-5 * (t * t - fell * fell)).epsilon(1e-9));
    } else if (t > 0) {
      CHECK(weld.force[1] == Approx(2 * 10 * (t - 0.005)).epsilon(1e-10));  // gravity of the step's middle
    }
  });
}

}  // namespace joints_tests
