// Forces of the scene against exact motions.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/scene.h"
#include "rigid_scenes.h"

namespace forces_tests {
using namespace seiche;

namespace {

ForceSpec field(const VectorFormula& acceleration) {
  ForceSpec f;
  f.name = "field";
  f.acceleration = acceleration;
  return f;
}

ForceSpec of_kind(ForceKind kind) {
  ForceSpec f;
  f.name = "force";
  f.kind = kind;
  return f;
}

// A body in an empty box, without gravity.
Scene dry_scene(int dim, SolidSpec solid) {
  Scene s = test::box_scene(dim, 12);
  s.time.fixed_step = 1e-3;
  s.solids = {std::move(solid)};
  return s;
}

SolidState after(const Scene& s, double end) {
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < end * (1 - 1e-12)) sim->step(end);
  return sim->solids()[0];
}

const Vec3 middle2(0.5, 0.5, 0), middle3(0.5, 0.5, 0.5);
const Vec3& middle(int dim) {
  return dim == 2 ? middle2 : middle3;
}

}  // namespace

TEST_CASE("a field that is the same everywhere acts as gravity does") {
  for (const int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 12);
    test::add_pool(s, 0.5);
    s.solids = {test::rigid_box("float", {0.3, 0.2, 0.3}, {0.5, 0.52, dim == 2 ? 0 : 0.5}, 600)};
    s.time.fixed_step = 2e-3;
    s.solver.tolerance = 1e-12;
    const auto run = [&](const Scene& scene) {
      const auto sim = make_simulation(scene, Communicator());
      for (int n = 0; n < 20; ++n) sim->step(1);
      return std::pair(sim->solids()[0].velocity[1], sim->stats().kinetic_energy);
    };
    Scene heavy = s;
    heavy.gravity = {0, -9.81, 0};
    s.forces = {field({"0", "-9.81", "0"})};
    const auto [v, energy] = run(heavy);
    const auto [w, other] = run(s);
    CHECK(w == Approx(v).epsilon(1e-5));  // faces in the air that are not solved for fall by gravity alone
    CHECK(other == Approx(energy).epsilon(1e-5));
  }
}

// u = a t in liquid that fills a periodic box.
TEST_CASE("a field sets uniform liquid off") {
  Scene s = test::box_scene(2, 8);
  test::add_pool(s, 2);
  test::make_periodic(s);
  s.forces = {field({"2*t", "-1", "0"})};
  s.time.fixed_step = 0.02;
  const auto sim = make_simulation(s, Communicator());
  for (int n = 0; n < 10; ++n) {
    const StepStats stats = sim->step(1);
    CHECK(stats.momentum[0] / 1000 == Approx(stats.time * stats.time).epsilon(1e-9));  // midpoint rule: exact
    CHECK(stats.momentum[1] / 1000 == Approx(-stats.time).epsilon(1e-9));
  }
}

// dM/dt = C rho w^2 A on a level surface between free-slip sides that are periodic along x.
TEST_CASE("wind drags the liquid's surface by its stress") {
  Scene s = test::box_scene(2, 16);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.47);
  for (SideSpec& side : s.domain.sides[0]) side.type = SideType::periodic;
  s.forces = {of_kind(ForceKind::wind)};
  s.forces[0].velocity = {"20", "0", "0"};
  s.forces[0].surface_drag = 0.002;
  s.time.fixed_step = 2e-3;
  const auto sim = make_simulation(s, Communicator());
  double momentum = 0;
  for (int n = 0; n < 25; ++n) momentum = sim->step(1).momentum[0];
  const double exact = 0.002 * 1.2 * 400 * sim->time();
  CHECK(momentum == Approx(exact).epsilon(1e-3));  // less what the wind no longer sees of the moving water
}

// A field alpha z x r turns a body of any shape by alpha t, and moves its centre as a point.
TEST_CASE("a field that changes over a body turns it") {
  for (const int dim : {2, 3}) {
    SolidSpec box = test::rigid_box("box", {0.3, 0.1, 0.2}, middle(dim), 500);
    Scene s = dry_scene(dim, box);
    s.forces = {field({"-3*(y - 0.5)", "3*(x - 0.5)", "0"})};
    const SolidState end = after(s, 0.05);
    CHECK(end.angular_velocity[2] == Approx(0.15).epsilon(1e-3));
    CHECK(end.velocity.norm() < 1e-6);
  }
}

TEST_CASE("points pull and vortices turn by their laws") {
  SolidSpec ball = test::rigid_ball("ball", 0.02, {0.75, 0.5, 0}, 500);
  Scene s = dry_scene(2, ball);
  s.forces = {of_kind(ForceKind::point)};
  s.forces[0].center = {0.5, 0.5, 0};
  s.forces[0].strength = "4";
  s.forces[0].radius = 0.25;
  const double pull = 4 * 0.25 * 0.25 * 0.25 / std::pow(2 * 0.25 * 0.25, 1.5);
  CHECK(after(s, 0.01).velocity[0] == Approx(-0.01 * pull).epsilon(1e-3));
  s.forces[0].kind = ForceKind::vortex;
  CHECK(after(s, 0.01).velocity[1] == Approx(0.04).epsilon(1e-3));  // at its radius: the strength
}

// v = w + (v0 - w) exp(-r t); the step's implicit rule is off by r dt/2.
TEST_CASE("drag draws solids and liquid to its velocity") {
  SolidSpec box = test::rigid_box("box", {0.2, 0.1, 0}, middle2, 500);
  box.rigid.velocity = {0.5, 0, 0};
  box.rigid.angular_velocity = {0, 0, 2};
  Scene s = dry_scene(2, box);
  s.forces = {of_kind(ForceKind::drag)};
  s.forces[0].rate = "4";
  s.forces[0].velocity = {"0.1", "0.2", "0"};
  const SolidState end = after(s, 0.25);
  const double rest = std::exp(-1.0);
  CHECK(end.velocity[0] == Approx(0.1 + 0.4 * rest).epsilon(3e-3));
  CHECK(end.velocity[1] == Approx(0.2 * (1 - rest)).epsilon(3e-3));
  CHECK(end.angular_velocity[2] == Approx(2 * rest).epsilon(3e-3));

  Scene flow = test::box_scene(2, 8);
  test::add_pool(flow, 2);
  test::make_periodic(flow);
  flow.liquid.velocity = {"0.5", "0", "0"};
  flow.forces = s.forces;
  flow.time.fixed_step = 0.01;
  const auto sim = make_simulation(flow, Communicator());
  StepStats stats;
  for (int n = 0; n < 25; ++n) stats = sim->step(1);
  CHECK(stats.momentum[0] / 1000 == Approx(0.1 + 0.4 * rest).epsilon(1e-9));
}

// F = C rho A w^2/2 with the frontal area: of a box its side, of a ball pi r^2.
TEST_CASE("wind pushes the dry side of solids that faces it") {
  for (const int dim : {2, 3}) {
    for (const bool round : {false, true}) {
      SolidSpec body = round ? test::rigid_ball("body", 0.2, middle(dim), 50)
                             : test::rigid_box("body", {0.2, 0.3, 0.4}, middle(dim), 50);
      Scene s = dry_scene(dim, body);
      s.forces = {of_kind(ForceKind::wind)};
      s.forces[0].velocity = {"10", "0", "0"};
      s.forces[0].drag_coefficient = 0.8;
      const double area = round ? (dim == 2 ? 0.4 : test::pi * 0.04) : (dim == 2 ? 0.3 : 0.12);
      const double volume =
          round ? (dim == 2 ? test::pi * 0.04 : 4.0 / 3 * test::pi * 0.008) : (dim == 2 ? 0.06 : 0.024);
      const double a = 0.5 * 1.2 * 0.8 * area * 100 / (50 * volume);
      CHECK(after(s, 1e-3).velocity[0] ==
            Approx(1e-3 * a).epsilon(round ? 0.02 : 2e-3));  // chords cut up to 2 % of the radius
    }
  }
}

TEST_CASE("a load acts where it is given and turns with the solid if it says so") {
  SolidSpec box = test::rigid_box("box", {0.2, 0.1, 0}, middle2, 500);
  Scene s = dry_scene(2, box);
  s.forces = {of_kind(ForceKind::load)};
  s.forces[0].force = {"3", "0", "0"};
  s.forces[0].at = Vec3(0.5, 0.54, 0);
  s.forces[0].torque = "0.5";
  const double mass = 500 * 0.02, inertia = mass * (0.04 + 0.01) / 12;
  const SolidState end = after(s, 1e-3);
  CHECK(end.velocity[0] == Approx(1e-3 * 3 / mass).epsilon(1e-6));
  CHECK(end.angular_velocity[2] == Approx(1e-3 * (0.5 - 3 * 0.04) / inertia).epsilon(1e-6));

  s.solids[0].rigid.angular_velocity = {0, 0, 0.5 * test::pi};
  s.solids[0].rigid.fixed_rotation = {false, false, false};
  s.forces[0].torque = "0";
  s.forces[0].at.reset();
  s.forces[0].turns_with_solid = true;  // turns by 90 degrees in a second: the impulse is F (2/pi, 2/pi)
  s.solids[0].rigid.density = 50;
  s.forces[0].force = {"0.1", "0", "0"};
  const SolidState turned = after(s, 1);
  CHECK(turned.velocity[0] == Approx(0.1 / 1.0 * 2 / test::pi).epsilon(2e-3));
  CHECK(turned.velocity[1] == Approx(0.1 / 1.0 * 2 / test::pi).epsilon(2e-3));
}

// An elastic bar in a field of one value falls as a whole; its nodes keep their distances.
TEST_CASE("fields act on every node of elastic solids") {
  SolidSpec bar = test::rigid_box("bar", {0.3, 0.1, 0}, middle2, 500);
  bar.kind = SolidKind::elastic;
  bar.elastic.youngs_modulus = 1e5;
  bar.elastic.poisson_ratio = 0.3;
  bar.elastic.element_size = 0.05;
  Scene s = dry_scene(2, bar);
  s.forces = {field({"2", "0", "0"})};
  const SolidState end = after(s, 0.1);
  CHECK(end.velocity[0] == Approx(0.2).epsilon(0.02));
  CHECK(end.position[0] == Approx(0.5 + 0.01).epsilon(1e-3));
}

TEST_CASE("forces act on the solids that they name and within their region") {
  Scene s = test::box_scene(2, 12);
  s.time.fixed_step = 1e-3;
  s.solids = {test::rigid_box("crate_a", {0.1, 0.1, 0}, {0.2, 0.5, 0}, 500),
              test::rigid_box("crate_b", {0.1, 0.1, 0}, {0.5, 0.5, 0}, 500),
              test::rigid_box("log", {0.1, 0.1, 0}, {0.8, 0.5, 0}, 500)};
  s.forces = {field({"0", "5", "0"}), field({"1", "0", "0"})};
  s.forces[0].solids = {"crate*"};
  s.forces[1].region.emplace();
  s.forces[1].region->kind = "box";
  s.forces[1].region->lower = {0.4, 0, 0};
  s.forces[1].region->upper = {1, 1, 0};
  s.forces[1].region->where = "test";
  const auto sim = make_simulation(s, Communicator());
  sim->step(1);
  const auto solids = sim->solids();
  CHECK(solids[0].velocity[1] == Approx(5e-3));
  CHECK(std::abs(solids[0].velocity[0]) < 1e-12);
  CHECK(solids[1].velocity[0] == Approx(1e-3));
  CHECK(std::abs(solids[2].velocity[1]) < 1e-12);
}

// A vortex drives water in a tank: what it does is booked as work, and little is lost by the scheme.
TEST_CASE("the work of forces is booked") {
  Scene s = test::box_scene(2, 32);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 2);
  ForceSpec vortex = of_kind(ForceKind::vortex);
  vortex.center = middle2;
  vortex.strength = "1";
  vortex.radius = 0.2;
  s.forces = {vortex};
  s.time.fixed_step = 0.01;
  const auto sim = make_simulation(s, Communicator());
  StepStats stats;
  for (int n = 0; n < 50; ++n) stats = sim->step(1);
  CHECK(stats.kinetic_energy > 5);
  CHECK(std::abs(stats.work.lost_numerical) < 0.05 * stats.kinetic_energy);
}

TEST_CASE("a force that is not finite stops the run with its place") {
  Scene s = test::box_scene(2, 8);
  test::add_pool(s, 0.5);
  s.forces = {field({"1/(x - x)", "0", "0"})};
  s.forces[0].where = "scene.toml:7";
  const auto sim = make_simulation(s, Communicator());
  CHECK_THROWS_WITH(sim->step(1), Catch::Contains("scene.toml:7: force \"field\" is not finite"));
}

}  // namespace forces_tests
