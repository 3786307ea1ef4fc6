// Floating and rising bodies against Archimedes and the added mass.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace rigid_floating_tests {
using namespace seiche;

namespace {

constexpr double side = 0.25;  // of a log's square section, m
constexpr int cells = 48;
constexpr double h = 1.0 / cells;

// A square log of density ratio s in a tank of width 1, its centre `lift` above its floating position, turned by
// `degrees`.
Scene log_scene(double s, double lift, double degrees) {
  Scene scene = test::box_scene(2, cells);
  scene.gravity = {0, -9.81, 0};
  test::add_pool(scene, 0.5);
  const double level = 0.5, draft_below_center = degrees == 0 || s != 0.5 ? (s - 0.5) * side : 0;
  scene.solids.push_back(
      test::rigid_box("log", {side, side, 0}, {0.5, level - draft_below_center + lift, 0}, 1000 * s, degrees));
  return scene;
}

struct Floating {
  double depth = 0;                     // mean depth of the centre below the level, m
  double degrees = 0;                   // mean
  double least = 1e300, most = -1e300;  // degrees
};

// The level follows from the volume of the water plus the log's submerged volume, the fraction s of it.
Floating float_on(const Scene& scene, double from, double until) {
  const auto sim = make_simulation(scene, Communicator());
  const double s = scene.solids[0].rigid.density / scene.liquid.density;
  const double start = scene.solids[0].shape.transform.rotate.degrees;
  test::SettledMean height{from, until}, turn{from, until};
  Floating f;
  while (sim->time() < until) {
    const StepStats step = sim->step(until);
    const SolidState log = sim->solids()[0];
    const double degrees = start + test::degrees_about_z(log);
    height.add(step.time, step.dt, log.position[1]);
    turn.add(step.time, step.dt, degrees);
    f.least = std::min(f.least, degrees), f.most = std::max(f.most, degrees);
  }
  f.depth = sim->stats().liquid_volume + s * side * side - height.value();
  f.degrees = turn.value();
  return f;
}

}  // namespace

// The centre of the section is the centre of mass: (s - 1/2) H below the level for a flat log, at the level for s =
// 1/2.
TEST_CASE("a log floats as deep as Archimedes says") {
  for (double s : {0.15, 0.5, 0.85}) {
    const Floating f = float_on(log_scene(s, h, s == 0.5 ? 45 : 0), 0, 8);
    const double error = std::abs(f.depth - (s - 0.5) * side) / h;
    WARN("s = " << s << ": draft off by " << error << " cells, bar 0.1");
    CHECK(error <= 0.1);
  }
}

// Floating flat is stable for 6 s (1 - s) < 1. Between 9/32 and 23/32 a square floats with a corner down.
TEST_CASE("a square log floats flat, or on a corner, as its density says", "[long]") {
  for (double s : {0.15, 0.5, 0.85}) {
    const Floating f = float_on(log_scene(s, 0, 10), 0, 12);
    const double expected = s == 0.5 ? 45 : 0;
    WARN("s = " << s << ": mean " << f.degrees << " degrees (" << f.least << " to " << f.most << "), expected "
                << expected);
    CHECK(std::abs(f.degrees - expected) <= 3);
    if (s != 0.5) CHECK(std::max(-f.least, f.most) <= 12);
  }
}

// A box of half the liquid's density whose sides lie along the axes, half under a level anywhere in a cell: pressure is
// linear and the load of each face exact. Load by shares of faces alone is that of the cell's centre and up to rho g
// h/2 off: 11 % of the buoyancy of a box of 8 cells.
TEST_CASE("a box that floats at rest stays at rest, wherever the grid's lines lie") {
  for (const int dim : {2, 3})
    for (const double level : {0.5, 0.51, 0.53, 0.555}) {
      Scene s = test::box_scene(dim, 16);
      s.gravity = {0, -9.81, 0};
      test::add_liquid(s, fmt::format("y - {}", level));
      const double z = dim == 3 ? 0.4 : 0;
      s.solids.push_back(test::rigid_box("box", {0.4, 0.4, z}, {0.5, level, dim == 3 ? 0.5 : 0}, 500));
      s.time.fixed_step = 0.005;
      const auto sim = make_simulation(s, Communicator());
      CAPTURE(dim, level);
      for (int n = 0; n < 5; ++n) CHECK(sim->step(sim->time() + 1).max_speed < 1e-7);  // the solve's tolerance is 1e-8
      CHECK(sim->solids()[0].velocity.norm() < 1e-7);
      CHECK(sim->solids()[0].angular_velocity.norm() < 1e-7);
    }
}

}  // namespace rigid_floating_tests
