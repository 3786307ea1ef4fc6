// Fixed steps, sources that open and close within steps, and values reported at the start and in the air.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "unit/coupling/end.h"
#include "verification/scenes.h"

namespace steps_tests {
using namespace seiche;

namespace {

// A full periodic box moving at 2 m/s; cells of 1/16 m.
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

// Volume of liquid after 0.1 s with a source across the box, open from 0.033 to 0.047 s at 1 m/s in still air.
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

TEST_CASE("a source brings its shape and what flows through it while it is open, whatever the steps are", "[long]") {
  for (int dim : {2, 3}) {
    const double expected = 0.25 + 0.014;
    const double within = volume_brought(dim, 0.1), split = volume_brought(dim, 0.02),
                 many = volume_brought(dim, 0.002);
    WARN(dim << "D: expected " << expected << ", in one step " << within << ", in steps of 0.02 s " << split
             << ", of 0.002 s " << many);
    for (const double volume : {within, split, many})
      CHECK(volume == Approx(expected).margin(1e-6));  // flat fronts: exact up to round-off and the solves
  }
}

// The liquid's surface lies 0.3 cells below a row of centres. A disc a fifth of a cell wide, nearer to one of them,
// bends phi there.
TEST_CASE("a source that reaches no cell's centre brings nothing and takes nothing") {
  for (int dim : {2, 3}) {
    const double h = 1.0 / 8;
    Scene s = test::box_scene(dim, 8);
    test::add_liquid(s, Formula(fmt::format("y-{}", 3.2 * h)));
    LiquidSourceSpec drop;
    drop.shape.kind = "sphere";
    drop.shape.center = {3.65 * h, 3.65 * h, dim == 3 ? 3.65 * h : 0};
    drop.shape.radius = 0.1 * h;
    s.liquid.sources.push_back(drop);
    const auto sim = make_simulation(s, Communicator());
    const double before = sim->stats().liquid_volume;
    while (sim->time() < 0.1) (void)sim->step(0.1);
    CHECK(sim->stats().liquid_volume == Approx(before).epsilon(1e-12));  // rounding
  }
}

TEST_CASE("moving solids are reported with their velocity at the start") {
  Scene s = test::box_scene(2, 16);
  s.solids = {mover("0.3*sin(2*t)", "90*t")};
  const auto sim = make_simulation(s, Communicator());
  const SolidState at_start = sim->solids().at(0);
  const double turn = 90 * 3.14159265358979323846 / 180;
  // The reference point is 0.1 m to the left of the centre of rotation.
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
  // The power 3/2 leaves an error of order sqrt(tau), tau = 1e-4 frames = 4e-6 s.
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
      for (const double y : {0.25, 0.75}) {
        ProbeSpec& probe = s.probes.emplace_back();
        probe.name = "p", probe.kind = kind, probe.position = {0.5, y, z};
      }
    const auto sim = make_simulation(s, Communicator());
    CHECK_FALSE(sim->probe(0).defined);  // before any solve
    CHECK(sim->probe(2).defined);
    (void)sim->step(0.01);
    CHECK(sim->probe(0).defined);
    CHECK(sim->probe(0).value == Approx(1000 * 9.81 * 0.25).epsilon(1e-6));
    CHECK_FALSE(sim->probe(1).defined);
    CHECK(sim->probe(2).defined);
    CHECK_FALSE(sim->probe(3).defined);
  }
}

// Without gravity and with liquid at rest, only moving sides, sources and solids tell how fast the flow will be.
TEST_CASE("the first step is bounded by sides, sources and solids that move") {
  const double h = 1.0 / 16, year = 1;
  const auto first_step = [&](Scene s) {
    s.time.frame_rate = 1 / year;
    return make_simulation(s, Communicator())->step(year).dt;
  };
  for (int dim : {2, 3}) {
    Scene full = test::box_scene(dim, 16);
    test::add_liquid(full, "-1");
    full.liquid.viscosity = "1";
    CHECK(first_step(full) == year);
    Scene lid = full;
    lid.domain.sides[1][1] = {SideType::moving_wall, {"1", "0", "0"}, "0"};
    CHECK(first_step(lid) <= h);
    lid.domain.sides[1][1].velocity[0] = "sin(6.28318530718*t)";
    CHECK(first_step(lid) <= 4 * h);
    Scene fed = full;
    fed.domain.sides[0][0] = {SideType::inflow, {"2*min(1,10*t)", "0", "0"}, "0"};
    fed.domain.sides[0][1].type = SideType::outflow;
    CHECK(first_step(fed) <= h);
    Scene source = test::box_scene(dim, 16);
    LiquidSourceSpec tap;
    tap.shape.kind = "sphere";
    tap.shape.center = {0.5, 0.5, dim == 3 ? 0.5 : 0};
    tap.shape.radius = 0.2;
    tap.velocity[1] = "-4";
    source.liquid.sources.push_back(tap);
    CHECK(first_step(source) <= h / 4);
    Scene moved = full;
    moved.domain.sides[0][1].type = SideType::outflow;
    moved.solids = {mover("0.2*sin(6.28318530718*t)")};
    CHECK(first_step(moved) <= 2 * h);
  }
}

// Rotation at 10 rad/s in a step of 0.05 s would stretch the body by an eighth.
TEST_CASE("the first step strains elastic bodies little by the velocities that they begin with") {
  for (int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 16);
    SolidSpec block;
    block.name = "block";
    block.kind = SolidKind::elastic;
    block.shape.kind = "box";
    block.shape.lower = {0.3, 0.4, dim == 3 ? 0.4 : 0};
    block.shape.upper = {0.7, 0.6, dim == 3 ? 0.6 : 0};
    block.shape.where = "test";
    block.rigid.density = 1000;
    block.rigid.angular_velocity = {0, 0, 10};
    block.elastic.youngs_modulus = 1e8;
    block.elastic.poisson_ratio = 0.3;
    block.elastic.element_size = 0.1;
    s.solids = {block};
    s.time.frame_rate = 20;
    const auto sim = make_simulation(s, Communicator());
    const double kinetic = sim->stats().kinetic_energy;
    const StepStats stats = sim->step(0.05);
    WARN(dim << "D: first step " << stats.dt << " s, elastic energy " << stats.elastic_energy / kinetic
             << " of the kinetic at the start");
    CHECK(stats.elastic_energy < 2e-3 * kinetic);
    CHECK(stats.kinetic_energy + stats.elastic_energy < 1.01 * kinetic);
  }
}

TEST_CASE("steps that do not resolve the eddies of a full viscous domain are told of at the start") {
  Scene s = test::box_scene(2, 16);
  test::add_liquid(s, "-1");
  s.liquid.viscosity = "1e-3";
  const auto warnings = [](const Scene& scene) { return make_simulation(scene, Communicator())->take_warnings(); };
  s.time.cfl = 2;
  CHECK(warnings(s).empty());
  s.time.cfl = 4;
  const std::vector<std::string> told = warnings(s);
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("time.cfl = 4: steps over more than 2 cells") == 0);
  s.liquid.viscosity = "0";
  CHECK(warnings(s).empty());
}

TEST_CASE("what is told of the start is not told again where a run goes on") {
  Scene s = test::box_scene(2, 16);
  test::add_liquid(s, "-1");
  test::add_liquid(s, "(x - 5)^2 + y^2 - 0.1");  // outside of the domain: a warning
  s.liquid.viscosity = "1e-3";
  s.time.cfl = 4;
  const auto sim = make_simulation(s, Communicator());
  CHECK(sim->take_warnings().size() == 2);
  const auto other = make_simulation(s, Communicator());
  other->load(sim->save());
  const std::vector<std::string> told = other->take_warnings();
  REQUIRE(told.size() == 1);  // a resumed run may have changed it
  CHECK(told[0].find("time.cfl = 4") == 0);
}

}  // namespace steps_tests
