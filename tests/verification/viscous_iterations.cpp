// Iterations of viscous solves in domains other than a plain box.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "scenes.h"

namespace viscous_iterations_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

// Oil flows through a channel over a step on its floor that closes half of it.
Scene channel_with_step() {
  Scene s = box_scene(2, 40, 0.2);
  s.domain.cells[0] = 120, s.domain.upper[0] = 0.6;
  for (SideSpec& side : s.domain.sides[1]) side.type = SideType::no_slip;
  s.domain.sides[0][0] = {SideType::inflow, {"30*y*(0.2-y)", "0", "0"}, "0"};
  s.domain.sides[0][1].type = SideType::outflow;
  s.liquid.density = 1000;
  s.liquid.viscosity = "1";
  s.time.end = 0.12, s.time.frame_rate = 25;
  add_liquid(s, "-1");
  SolidSpec step;
  step.name = "step";
  step.slip = Slip::no_slip;
  step.shape.kind = "expression";
  step.shape.phi = "max(abs(x-0.21)-0.01, y-0.1)";
  step.shape.where = "test";
  s.solids.push_back(step);
  return s;
}

// Liquid between a moving and a resting plate.
Scene plates(int dimension) {
  Scene s = box_scene(dimension, 16, 1.0);
  for (int a = 0; a < dimension; ++a)
    for (SideSpec& side : s.domain.sides[a]) side.type = SideType::periodic;
  s.domain.sides[1][0].type = SideType::no_slip;
  s.domain.sides[1][1] = {SideType::moving_wall, {"1", "0", "0"}, "0"};
  s.liquid.density = 1;
  s.liquid.viscosity = "1";
  s.solver.viscosity = ViscousSolve::coupled;
  s.time.end = 0.5, s.time.frame_rate = 2, s.time.max_step = 0.05;
  add_liquid(s, "-1");
  return s;
}

}  // namespace

// With PFMG for the pressure, which was not positive here, 400 iterations did not suffice.
TEST_CASE("viscosity: a channel with a step takes as few iterations as a box", "[viscous][ranks]") {
  const Scene scene = channel_with_step();
  auto run = make_simulation(scene, Communicator());
  while (run->time() < scene.time.end) CHECK(run->step(scene.time.end).solver_iterations <= 25);  // 12 to 15
}

// All velocities are free of divergence up to round-off, so no continuity residual is small relative to it: 400
// iterations did not suffice.
TEST_CASE("viscosity: shear between plates leaves nothing to do for the pressure", "[viscous][ranks]") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  const Scene scene = plates(dimension);
  auto run = make_simulation(scene, Communicator());
  while (run->time() < scene.time.end) CHECK(run->step(scene.time.end).solver_iterations <= 12);  // 6 or 7
}

}  // namespace viscous_iterations_tests
