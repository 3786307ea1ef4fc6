// Jointed bodies in liquid, against added masses and statics.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "joint_scenes.h"

namespace joints_in_liquid_tests {
using namespace seiche;
using test::add_liquid, test::add_pool, test::hinge, test::joint, test::pi;

namespace {

constexpr double radius = 0.25, tank = 0.5;

// A disc or sphere on a massless rod of a metre in a full round tank, at rest a little beside the middle. Light ones
// are tethered from below.
Scene bob_in_tank(int dimension, int cells_a_radius, double ratio) {
  const double h = radius / cells_a_radius;
  Scene s = test::swing_scene(dimension, tank + 2 * h, h);
  add_liquid(s, "-1");
  SolidSpec wall = test::rigid_ball("tank", tank, Vec3::Zero(), 1);
  wall.kind = SolidKind::fixed;
  wall.shape.invert = true;
  const double side = ratio > 1 ? 1 : -1, away = 0.02, up = side * (1 - std::sqrt(1 - away * away));
  s.solids = {wall, test::rigid_ball("bob", radius, {away, up, 0}, 1000 * ratio)};
  s.joints = {joint("rod", JointKind::distance, "bob", "world", {away, up, 0})};
  s.joints[0].to = Vec3(0, side, 0);
  s.solver.tolerance = 1e-8;
  return s;
}

struct Swing {
  double period = 0;
  double iterations = 0;  // a step
};

Swing swing_of(Scene s, double expected, int steps = 150) {
  s.time.max_step = expected / steps;
  s.time.frame_rate = 0.5 / expected;
  const auto sim = make_simulation(s, Communicator());
  test::Crossings through;
  Swing swing;
  while (through.times.size() < 2) {
    swing.iterations += sim->step(2 * expected).solver_iterations;
    through.add(sim->time(), sim->solids()[1].position[0]);
    CHECK(sim->stats().joint_gap <= 1e-9);
  }
  swing.iterations /= double(sim->step_count());
  swing.period = 2 * (through.times[1] - through.times[0]);
  return swing;
}

}  // namespace

// omega^2 = |s - 1| g/(L (s + C)), C = (R^2 + a^2)/(R^2 - a^2) the added mass of a disc in a concentric tank, s its
// density over the liquid's. Bars: 2 % at 8 cells a radius, 1 % at 16.
TEST_CASE("joints: a pendulum in a full tank swings with the exact added mass, heavy or light", "[joints][long]") {
  const double C = (tank * tank + radius * radius) / (tank * tank - radius * radius);
  for (const double ratio : {7.8, 2.0, 1e-3}) {
    const double exact = 2 * pi / std::sqrt(std::abs(ratio - 1) * 9.81 / (ratio + C));
    const Swing coarse = swing_of(bob_in_tank(2, 8, ratio), exact), fine = swing_of(bob_in_tank(2, 16, ratio), exact);
    WARN("density ratio " << ratio << ": period off by " << 100 * (coarse.period / exact - 1) << " and "
                          << 100 * (fine.period / exact - 1) << " %; " << coarse.iterations << ", " << fine.iterations
                          << " iterations a step");
    CHECK(std::abs(coarse.period / exact - 1) <= 4e-3);  // -0.03, -0.08, -0.18 %
    CHECK(std::abs(fine.period / exact - 1) <= 2e-3);    // 0.00, 0.01, 0.02 %
  }
}

// The same in 3D (Stokes 1850): C = (b^3 + 2 a^3)/(2 (b^3 - a^3)) for a sphere of radius a in a tank of radius b.
double sphere_off_by(int cells_a_radius, double ratio) {
  const double a3 = std::pow(radius, 3), b3 = std::pow(tank, 3), C = 0.5 * (b3 + 2 * a3) / (b3 - a3);
  const double exact = 2 * pi / std::sqrt(std::abs(ratio - 1) * 9.81 / (ratio + C));
  const double off = swing_of(bob_in_tank(3, cells_a_radius, ratio), exact, 60).period / exact - 1;
  WARN("sphere, density ratio " << ratio << ", " << cells_a_radius << " cells a radius: period off by " << 100 * off
                                << " %");
  return off;
}

// Bars: 2 % at 8 cells a radius, 1 % at 16.
TEST_CASE("joints: a sphere in a full spherical tank swings with the exact added mass", "[joints]") {
  CHECK(std::abs(sphere_off_by(8, 2)) <= 0.02);  // -0.19 %
}

TEST_CASE("joints: a sphere in a full spherical tank, heavy, light and finer", "[joints][long]") {
  for (const double ratio : {7.8, 1e-3}) CHECK(std::abs(sphere_off_by(8, ratio)) <= 0.02);
  CHECK(std::abs(sphere_off_by(16, 2)) <= 0.01);
}

// Weight and buoyancy (rho V - m) g on the rod of a body at rest.
TEST_CASE("joints: the tension of a tethered body is its buoyancy less its weight", "[joints]") {
  for (const int dim : {2, 3})
    for (const double ratio : {0.3, 2.0}) {
      Scene s = test::swing_scene(dim, 0.5, 1.0 / 16);
      add_liquid(s, "y-0.4");
      s.solids = {test::rigid_ball("ball", 0.2, Vec3::Zero(), 1000 * ratio)};
      s.joints = {joint("tether", JointKind::distance, "ball", "world", Vec3::Zero())};
      s.joints[0].to = Vec3(0, ratio < 1 ? -0.4 : 0.4, 0);
      s.solver.tolerance = 1e-12;
      s.time.frame_rate = 10;
      const auto sim = make_simulation(s, Communicator());
      for (int n = 0; n < 3; ++n) (void)sim->step(1);
      const SolidState ball = sim->solids()[0];
      const Vec3 load = ball.force, pull = sim->joints()[0].force;
      const double weight = load[1] + pull[1];
      CAPTURE(dim, ratio, load[1], pull[1]);
      const double volume = dim == 2 ? pi * 0.04 : 4 * pi / 3 * 0.008;
      CHECK(pull[1] == Approx((ratio - 1) * 1000 * volume * 9.81).epsilon(dim == 2 ? 1e-3 : 1e-2));  // its mesh
      CHECK(weight == Approx(pull[1] * ratio / (ratio - 1)).epsilon(1e-8));
    }
}

// Buoyancy acts at the middle of the ball, the weight at a centre of mass that the scene gives.
TEST_CASE("joints: buoyancy turns a body about a centre of mass beside its middle", "[joints]") {
  for (const int dim : {2, 3}) {
    Scene s = test::swing_scene(dim, 0.5, 1.0 / 16);
    add_liquid(s, "y-0.4");
    s.solids = {test::rigid_ball("ball", 0.2, Vec3::Zero(), 0)};
    s.solids[0].rigid.mass = 50;
    s.solids[0].rigid.center_of_mass = Vec3(0.05, 0.02, 0);
    s.joints = {joint("hold", JointKind::weld, "ball", "world", {0.05, 0.02, 0})};
    s.solver.tolerance = 1e-12;
    const auto sim = make_simulation(s, Communicator());
    for (int n = 0; n < 3; ++n) (void)sim->step(1);
    const Vec3 load = sim->solids()[0].force, hold = sim->joints()[0].force, torque = sim->joints()[0].torque;
    CAPTURE(dim, load, hold, torque);
    CHECK(load[1] + hold[1] == Approx(50 * 9.81).epsilon(1e-8));
    CHECK(torque[2] == Approx(0.05 * load[1]).epsilon(1e-8));
  }
}

// Discs in a chain that lies in full liquid, whatever they weigh: joints leave the number of iterations as it is.
TEST_CASE("joints: chains take as many liquid iterations as loose bodies", "[joints]") {
  for (const double ratio : {1e-6, 1e-3, 1.0, 10.0}) {
    std::array<int, 2> iterations{};
    for (const int jointed : {0, 1}) {
      Scene s = test::swing_scene(2, 1, 1.0 / 16);
      add_liquid(s, "-1");
      for (int k = 0; k < 5; ++k) {
        const double x = -0.6 + 0.3 * k;
        s.solids.push_back(test::rigid_ball(fmt::format("disc{}", k), 0.12, {x, 0.1 * (k % 2), 0}, 1000 * ratio));
        if (jointed && k > 0)
          s.joints.push_back(hinge(fmt::format("link{}", k), fmt::format("disc{}", k), fmt::format("disc{}", k - 1),
                                   {x - 0.15, 0.05, 0}));
      }
      // A loop, too: a rod from end to end, and a hinge that is there twice.
      if (jointed) {
        s.joints.push_back(joint("rod", JointKind::distance, "disc0", "disc4", {-0.6, 0, 0}));
        s.joints.back().to = Vec3(0.6, 0, 0);
        s.joints.push_back(s.joints[0]);
        s.joints.back().name = "again";
      }
      s.solver.tolerance = 1e-8;
      const auto sim = make_simulation(s, Communicator());
      for (int n = 0; n < 4; ++n) {
        const StepStats stats = sim->step(1);
        iterations[std::size_t(jointed)] =
            std::max(iterations[std::size_t(jointed)], stats.solver_iterations / (1 + stats.joint_turns));
      }
    }
    WARN("density ratio " << ratio << ": " << iterations[0] << " iterations of loose discs, " << iterations[1]
                          << " of jointed ones");
    CHECK(iterations[1] <= iterations[0] + 2);
  }
}

namespace {

// A disc in a round tank full of viscous liquid, driven at 1 rad/s from the start on.
Scene disc_in_tank(double h) {
  Scene s = test::swing_scene(2, tank + 2 * h, h, 0);
  add_liquid(s, "-1");
  s.liquid.density = 1, s.liquid.viscosity = "1";
  SolidSpec wall = test::rigid_ball("tank", tank, Vec3::Zero(), 1);
  wall.kind = SolidKind::fixed;
  wall.shape.invert = true;
  s.solids = {wall, test::rigid_ball("disc", radius, Vec3::Zero(), 2)};
  for (SolidSpec& solid : s.solids) solid.slip = Slip::no_slip;
  s.joints = {hinge("axle", "disc", "world", Vec3::Zero())};
  s.joints[0].drive.emplace().degrees = "180/pi*t";
  return s;
}

}  // namespace

// Torque 4 pi mu Omega r1^2 r2^2/(r2^2 - r1^2) of a disc that turns in a round tank; 2D, per metre. Bar: 0.1 % at 64
// cells a metre.
TEST_CASE("joints: drive and motor of a disc in viscous liquid have Couette's torque", "[joints][viscous]") {
  const double exact = 4 * pi * 0.0625 * 0.25 / (0.25 - 0.0625);
  std::array<double, 2> error{};
  for (const int level : {0, 1}) {
    const double h = level == 0 ? 1.0 / 32 : 1.0 / 64;
    Scene s = disc_in_tank(h);
    s.time.max_step = 0.05;
    const auto driven = make_simulation(s, Communicator());
    while (driven->time() < 0.5) (void)driven->step(10);
    error[std::size_t(level)] = driven->joints()[0].torque[2] / exact - 1;
    if (level == 0) continue;
    s.joints[0].drive.reset();
    s.joints[0].motor.emplace().speed = "100";
    s.joints[0].motor->torque = 0.5;
    const auto pulled = make_simulation(s, Communicator());
    while (pulled->time() < 0.5) (void)pulled->step(10);
    CHECK(pulled->joints()[0].rate == Approx(0.5 / exact).epsilon(1e-3));  // +0.07 %
  }
  WARN("torque off by " << 100 * error[0] << " and " << 100 * error[1] << " %");
  // -0.124, -0.063 %, and -0.024 % with 128 cells a metre
  CHECK(std::abs(error[0]) <= 2e-3);
  CHECK(std::abs(error[1]) <= 1e-3);
}

namespace {

// Eigenfunction of angular velocity times radius between the disc and the tank, zero at the tank.
double bessel_mode(double k, double r) {
  return std::cyl_bessel_j(1, k * r) * std::cyl_neumann(1, k * tank) -
         std::cyl_neumann(1, k * r) * std::cyl_bessel_j(1, k * tank);
}

// Torque by which a disc that turns at 1 rad/s from t = 0 on sets liquid off, density = viscosity = 1, over that of the
// steady flow v: v - sum A_n B_n(r) exp(-k_n^2 t), A_n by projection of v.
double torque_of_start(double t) {
  const double a2 = radius * radius, b2 = tank * tank, h = (tank - radius) / 2000;
  const auto steady = [&](double r) { return a2 / (b2 - a2) * (b2 / r - r); };
  double torque = 1;
  for (int n = 1; n <= 8; ++n) {
    double low = (n - 0.3) * pi / (tank - radius), high = (n + 0.3) * pi / (tank - radius);
    while (high - low > 1e-10) {
      const double middle = 0.5 * (low + high);
      (bessel_mode(low, radius) * bessel_mode(middle, radius) <= 0 ? high : low) = middle;
    }
    double with_flow = 0, with_itself = 0;
    for (double r = radius + h / 2; r < tank; r += h) {
      const double B = bessel_mode(low, r);
      with_flow += r * steady(r) * B, with_itself += r * B * B;
    }
    const double slope = (bessel_mode(low, radius + h) - bessel_mode(low, radius - h)) / (2 * h);
    // The steady flow's shear is -2 b^2/(b^2 - a^2) at the disc.
    torque += with_flow / with_itself * slope * std::exp(-low * low * t) / (2 * b2 / (b2 - a2));
  }
  return torque;
}

}  // namespace

TEST_CASE("joints: a disc that is driven from rest has the torque of Bessel's series", "[joints][viscous]") {
  const double exact = 4 * pi * 0.0625 * 0.25 / (0.25 - 0.0625), h = 1.0 / 32, dt = 5e-4;
  Scene s = disc_in_tank(h);
  s.time.fixed_step = dt;
  test::run_steps(s, 0.02, [&](const Simulation& sim) {
    if (sim.time() < 0.004) return;
    const double middle = sim.time() - dt / 2;  // torques are means over a step
    CHECK(sim.joints()[0].torque[2] == Approx(exact * torque_of_start(middle)).epsilon(0.02));  // 1.2 to 0.02 %
    if (sim.step_count() % 8 == 0)
      WARN("after " << middle << " s: off by "
                    << 100 * (sim.joints()[0].torque[2] / (exact * torque_of_start(middle)) - 1) << " %");
  });
}

enum class GateHeld { driven, welded };

// Water of depth 0.625 m behind a gate that stands in the floor, `thick` cells of 1/16 m thick, to the left of it. The
// water's region ends in the middle of the gate.
JointReport foot_of_gate(GateHeld how, int thick, int steps) {
  Scene s = test::box_scene(2, 32, 2);
  s.domain.upper[1] = 1, s.domain.cells[1] = 16;
  s.gravity = Vec3(0, -9.81, 0);
  const double width = thick / 16.0;
  add_pool(s, 0.75);
  s.liquid.regions[0].shape.upper[0] = 1 + width / 2;
  SolidSpec floor = test::rigid_box("floor", {4, 1, 0}, {1, 0.125 - 0.5, 0}, 1);
  floor.kind = SolidKind::fixed;
  s.solids = {floor, test::rigid_box("gate", {width, 0.9, 0}, {1 + width / 2, 0.5, 0}, 2000)};
  s.joints = {how == GateHeld::driven ? hinge("foot", "gate", "floor", {1 + width / 2, 0.125, 0})
                                      : joint("foot", JointKind::weld, "gate", "floor", {1 + width / 2, 0.125, 0})};
  if (how == GateHeld::driven) s.joints[0].drive.emplace().degrees = "0";
  s.solver.tolerance = 1e-12;
  s.time.frame_rate = 10;
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < steps; ++n) (void)sim->step(1);
  CHECK(sim->joints()[0].force[1] == Approx(width * 0.9 * 2000 * 9.81).epsilon(1e-8));
  return sim->joints()[0];
}

// Force rho g H^2/2 and moment rho g H^3/6 on a gate along faces of the grid. The water's region ends within the gate,
// where redistancing rounds its edge. In a gate of two cells this changes the volume that is measured at its wet face,
// and control of the volume raises the level: by 1e-3 of the depth at most.
TEST_CASE("joints: a gate's hinge bears the moment of the water behind it", "[joints]") {
  const double depth = 0.625, force = 0.5 * 9810 * depth * depth, moment = force * depth / 3;
  for (const GateHeld how : {GateHeld::driven, GateHeld::welded})
    for (const int thick : {8, 2}) {
      const JointReport foot = foot_of_gate(how, thick, 10);
      WARN(thick << " cells thick: force " << -foot.force[0] / force - 1 << ", moment " << foot.torque[2] / moment - 1
                 << " off");
      CHECK(-foot.force[0] == Approx(force).epsilon(thick > 2 ? 1e-8 : 2e-3));  // 1e-13, 9.7e-4
      CHECK(foot.torque[2] == Approx(moment).epsilon(thick > 2 ? 1e-8 : 2e-3));
    }
}

// A gate that leans by 17 degrees: rho g H^3/(6 cos^2) about the foot of its wet face, less that of its weight.
TEST_CASE("joints: a leaning gate's hinge bears the moment of the water behind it", "[joints]") {
  const double lean = 17 * pi / 180, depth = 0.6, width = 0.2, height = 0.85, density = 2000;
  Scene s = test::box_scene(2, 128, 2);
  s.domain.upper[1] = 1, s.domain.cells[1] = 64;
  s.gravity = Vec3(0, -9.81, 0);
  // The foot of the wet face, the way up along it, and that into the gate.
  const Vec3 foot(0.9, 0.125, 0), up(std::sin(lean), std::cos(lean), 0), in(std::cos(lean), -std::sin(lean), 0);
  const Vec3 center = foot + (0.5 * height - 0.05) * up + 0.5 * width * in;
  add_liquid(s, fmt::format("max(y-{},(x-{})*{}-(y-{})*{}-{})", foot[1] + depth, foot[0], in[0], foot[1], -in[1],
                            0.5 * width));
  SolidSpec floor = test::rigid_box("floor", {4, 1, 0}, {1, 0.125 - 0.5, 0}, 1);
  floor.kind = SolidKind::fixed;
  s.solids = {floor, test::rigid_box("gate", {width, height, 0}, center, density, -17)};
  s.joints = {hinge("foot", "gate", "floor", foot)};
  s.joints[0].drive.emplace().degrees = "0";
  s.solver.tolerance = 1e-10;
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < 5; ++n) (void)sim->step(1);
  const double of_weight = -density * width * height * 9.81 * (center[0] - foot[0]);
  const double moment = 9810 * std::pow(depth, 3) / 6 / std::pow(std::cos(lean), 2);
  const double borne = sim->joints()[0].torque[2] + of_weight;
  WARN("moment off by " << borne / moment - 1);
  CHECK(borne == Approx(moment).epsilon(5e-3));  // -0.03 %; with cells twice as large -0.96 %
}

TEST_CASE("joints: a piston driven into a full cylinder is refused by name, held there it does nothing", "[joints]") {
  for (const bool drives : {true, false}) {
    Scene s = test::swing_scene(2, 0.5, 0.05);
    add_liquid(s, "-1");
    SolidSpec cylinder = test::rigid_box("cylinder", {0.8, 0.3, 0}, Vec3::Zero(), 1);
    cylinder.kind = SolidKind::fixed;
    cylinder.shape.invert = true;
    s.solids = {cylinder, test::rigid_box("piston", {0.2, 0.4, 0}, {0.1, 0, 0}, 2000)};
    s.joints = {joint("slide", JointKind::slider, "piston", "cylinder", Vec3::Zero())};
    s.joints[0].axis = Vec3(1, 0, 0);
    if (drives) s.joints[0].drive.emplace().translate = "0.1*t";
    if (!drives) s.joints.push_back(joint("lock", JointKind::weld, "piston", "cylinder", Vec3::Zero()));
    const auto sim = make_simulation(s, Communicator());
    if (drives) {
      try {
        (void)sim->step(1);
        FAIL("the piston moved");
      } catch (const Error& error) {
        CHECK(error.code() == ExitCode::cannot_continue);
        CHECK_THAT(error.what(), Catch::Matchers::Contains("'slide'"));
      }
    } else {
      for (int n = 0; n < 5; ++n) (void)sim->step(1);
      CHECK(sim->solids()[1].velocity.norm() <= 1e-9);
    }
  }
}

}  // namespace joints_in_liquid_tests
