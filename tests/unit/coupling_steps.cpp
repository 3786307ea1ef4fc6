// Pinned steps, sources that open and close within steps, and what is reported at the start and in the air.
#include <catch2/catch.hpp>

#include "../verification/scenes.h"
#include "coupling_end.h"

using namespace seiche;

namespace {

// Periodic, full, moving at 2 m/s; cells of 1/16 m.
Scene stream(double cfl, double fixed_step) {
  Scene s = test::box_scene(2, 16);
  test::make_periodic(s);
  test::add_liquid(s, "-1");
  s.liquid.velocity[0] = "2";
  s.time.cfl = cfl;
  s.time.fixed_step = fixed_step;
  s.time.frame_rate = 4;
  s.time.end = 0.5;
  return s;
}

SolidSpec mover(const Formula& x, const Formula& degrees = "0") {
  SolidSpec s;
  s.name = "mover";
  s.kind = SolidKind::kinematic;
  s.shape.kind = "sphere";
  s.shape.center = {0.4, 0.5, 0};
  s.shape.radius = 0.1;
  s.motion.translate[0] = x;
  s.motion.degrees = degrees;
  s.motion.center = {0.5, 0.5, 0};
  return s;
}

void check_end(const Scene& s, ExitCode expected, const std::vector<std::string>& texts) {
  const auto [text, code] = test::end_of(s, s.time.end);
  INFO(text);
  CHECK(code == expected);
  for (const std::string& part : texts) CHECK(text.find(part) != std::string::npos);
}

// Liquid in the box after 0.1 s of a source across it, open from 0.033 to 0.047 s at 1 m/s in still air.
double volume_brought(int dim, double longest_step) {
  Scene s = test::box_scene(dim, 32);
  LiquidSourceSpec tap;
  tap.shape.kind = "box";
  tap.shape.lower = {0.25, 0, 0};
  tap.shape.upper = {0.5, 1, dim == 3 ? 1.0 : 0.0};
  tap.velocity[0] = "1";
  tap.from = 0.033;
  tap.until = 0.047;
  s.liquid.sources.push_back(tap);
  s.time.max_step = longest_step;
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 0.1) (void)sim->step(0.1);
  return sim->stats().liquid_volume;
}

}  // namespace

TEST_CASE("a pinned step may carry the flow as many cells as cfl rounded up, and no further") {
  check_end(stream(1, 0.0625 / 2), ExitCode::done, {});
  check_end(stream(1.5, 0.0625), ExitCode::done, {});
  check_end(stream(1, 0.05), ExitCode::bad_input,
            {"time.fixed_step = 0.05 s", "the flow 1.6 cells of 0.0625 m; at most 1 are possible at cfl = 1",
             "lower fixed_step or raise cfl"});
}

TEST_CASE("a flow that outgrows the pinned step ends the run with figures") {
  Scene s = stream(1, 0.025);
  s.liquid.velocity[0] = "0";
  s.gravity = {9.81, 0, 0};
  check_end(s, ExitCode::cannot_continue, {"time.fixed_step = 0.025 s", "carries the flow 1.", "lower fixed_step"});
}

TEST_CASE("a motion too fast for the pinned step is known at the start") {
  Scene s = stream(1, 0.025);
  s.liquid.velocity[0] = "0";
  s.solids = {mover("t < 0.2 ? t : 0.2+3*(t-0.2)")};
  check_end(s, ExitCode::bad_input, {"carries a solid 1.2 cells of 0.0625 m; at most 1 is possible"});
  s.solids = {mover("2*t")};
  s.liquid.regions.clear();
  s.liquid.velocity[0] = "0";
  check_end(s, ExitCode::done, {});
}

TEST_CASE("steps that are hopelessly short are refused with the limit") {
  Scene s = stream(1, 1e-9);
  check_end(s, ExitCode::cannot_continue, {"are too short", "(limit 1000000 steps)"});
}

TEST_CASE("a source brings its shape and what flows through it while it is open, whatever the steps are") {
  for (int dim : {2, 3}) {
    const double expected = 0.25 + 0.014;
    const double within = volume_brought(dim, 0.1), split = volume_brought(dim, 0.02),
                 many = volume_brought(dim, 0.002);
    WARN(dim << "D: expected " << expected << ", in one step " << within << ", in steps of 0.02 s " << split
             << ", of 0.002 s " << many);
    for (const double volume : {within, split, many})
      CHECK(volume == Approx(expected).margin(1e-6));  // flat fronts: exact but for rounding and the solves
  }
}

TEST_CASE("moving solids are reported with their velocity at the start") {
  Scene s = test::box_scene(2, 16);
  s.solids = {mover("0.3*sin(2*t)", "90*t")};
  const auto sim = make_simulation(s, Communicator());
  const SolidState at_start = sim->solids().at(0);
  const double turn = 90 * 3.14159265358979323846 / 180;
  // Reference point 0.1 m to the left of the centre it turns about.
  CHECK(at_start.velocity[0] == Approx(0.6).epsilon(1e-8));
  CHECK(at_start.velocity[1] == Approx(-0.1 * turn).epsilon(1e-8));
  CHECK(at_start.angular_velocity[2] == Approx(turn).epsilon(1e-8));
  (void)sim->step(0.01);
  CHECK(sim->solids().at(0).angular_velocity[2] == Approx(turn).epsilon(1e-8));
}

TEST_CASE("a motion that is defined from the start on alone has a velocity there") {
  Scene s = test::box_scene(2, 16);
  s.solids = {mover("sqrt(t*t*t)+0.5*t")};
  const auto sim = make_simulation(s, Communicator());
  // The 3/2 power leaves an error of order sqrt(tau), tau = 1e-4 frames = 4e-6 s.
  CHECK(sim->solids().at(0).velocity[0] == Approx(0.5).epsilon(3e-3));
}

TEST_CASE("pressure and velocity probes measure nothing in the air") {
  for (int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 16);
    s.gravity = {0, -9.81, 0};
    s.solver.tolerance = 1e-12;
    test::add_liquid(s, "y-0.5");
    const double z = dim == 3 ? 0.5 : 0;
    for (const ProbeKind kind : {ProbeKind::pressure, ProbeKind::velocity})
      for (const double y : {0.25, 0.75}) s.probes.push_back({"p", kind, {0.5, y, z}, {}});
    const auto sim = make_simulation(s, Communicator());
    (void)sim->step(0.01);
    CHECK(sim->probe(0).defined);
    CHECK(sim->probe(0).value == Approx(1000 * 9.81 * 0.25).epsilon(1e-6));
    CHECK_FALSE(sim->probe(1).defined);
    CHECK(sim->probe(2).defined);
    CHECK_FALSE(sim->probe(3).defined);
  }
}
