// Elastic solids in the first steps, without liquid.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "base/scene.h"
#include "elastic_scenes.h"
#include "rigid_scenes.h"

namespace elastic_start_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

const Vec3 weight(0, -9.81, 0);  // per kg

// A soft block that is let go in empty space, at rest or thrown.
Scene falling_block(int dim, const Vec3& velocity) {
  Scene s = box_scene(dim, 16);
  const double z = dim == 3 ? 1 : 0;
  SolidSpec block =
      elastic_box("block", {0.4, 0.6, 0.4 * z}, {0.6, 0.8, 0.6 * z}, 1000, {1e5, 0.3}, dim == 2 ? 0.05 : 0.1);
  block.rigid.velocity = velocity;
  s.solids.push_back(block);
  s.gravity = weight;
  s.time.end = 1;
  return s;
}

}  // namespace

// The scheme is exact in v for a constant acceleration. In place it is ahead by 3/4 g dt^2 of the first step, which is
// at most sqrt(h/(8 g)).
TEST_CASE("elastic start: a body let go falls from the first step on") {
  const int dim = GENERATE(2, 3);
  const Vec3 thrown = GENERATE(Vec3{0, 0, 0}, Vec3{0.3, 0.5, 0});
  const Scene s = falling_block(dim, thrown);
  const auto simulation = make_simulation(s, Communicator());
  const Vec3 start = simulation->solids()[0].position;
  while (simulation->time() < 0.12) {
    simulation->step(s.time.end);
    const double t = simulation->time();
    const SolidState block = simulation->solids()[0];
    CAPTURE(dim, t);
    // Newton's method stops at 1e-6 of the step's motion.
    CHECK((block.velocity - (thrown + t * weight)).norm() < 1e-4);
    const Vec3 fallen = start + t * thrown + 0.5 * t * t * weight;
    CHECK((block.position - fallen).norm() < 0.1 * s.domain.cell_size);
  }
}

// A rigid block hangs a tenth of a cell below an elastic one. Both are let go: the gap stays, and no one pushes.
TEST_CASE("elastic start: a rigid and an elastic body fall side by side") {
  const int dim = GENERATE(2, 3);
  Scene s = falling_block(dim, {0, 0, 0});
  const double z = dim == 3 ? 1 : 0, gap = 0.1 * s.domain.cell_size;
  s.solids.push_back(rigid_box("rigid", {0.2, 0.1, 0.2}, {0.5, 0.55 - gap, 0.5 * z}, 1000));
  s.time.fixed_step = 0.03;
  const auto simulation = make_simulation(s, Communicator());
  const double apart = simulation->solids()[0].position.y() - simulation->solids()[1].position.y();
  simulation->step(s.time.end);
  const auto solids = simulation->solids();
  CHECK(solids[0].position.y() - solids[1].position.y() == Approx(apart).margin(0.01 * gap));
  CHECK(solids[0].velocity.y() == Approx(-9.81 * 0.03).epsilon(1e-3));
}

// Pins that move at once strike a blow against body and liquid. It is over before the account begins, and counts half
// of the energy twice where it is not left out.
TEST_CASE("elastic start: a blow of pins does no work later") {
  const int dim = GENERATE(2, 3);
  Scene s = box_scene(dim, 10);
  add_liquid(s, "y-0.75");
  s.time.end = 0.5;
  s.time.fixed_step = 1e-3;
  SolidSpec block = elastic_box("block", {0.3, 0.3, 0.3}, {0.7, 0.7, 0.7}, 100, {1e6, 0.3}, 0.1);
  PinSpec pin;
  pin.shape = block.shape;
  pin.motion.translate[0] = "0.2*t";
  block.elastic.pinned.push_back(pin);
  s.solids.push_back(block);
  const auto sim = make_simulation(s, Communicator());
  StepStats last;
  for (int n = 0; n < 5; ++n) last = sim->step(0.5);
  CAPTURE(dim, last.kinetic_energy, last.work.solids);
  CHECK(std::abs(last.work.lost_numerical) < 0.1 * last.kinetic_energy);
}

// Liquid at rest takes part of the momentum of a disc of its density that is thrown in it: its added mass is that of
// the liquid it displaces, so half of the energy is left. Were the liquid to set out from rest twice, it were a
// quarter.
TEST_CASE("elastic start: a disc thrown in liquid gives it momentum once") {
  Scene s = box_scene(2, 32);
  add_liquid(s, "-1");
  s.time.end = 1;
  SolidSpec disc = elastic_solid("disc", 1000, {1e5, 0.3}, 0.03);
  disc.shape.kind = "sphere";
  disc.shape.center = {0.5, 0.5, 0};
  disc.shape.radius = 0.1;
  disc.rigid.velocity = {0.5, 0, 0};
  s.solids.push_back(disc);
  const auto simulation = make_simulation(s, Communicator());
  const double start = simulation->stats().kinetic_energy;
  for (int n = 0; n < 3; ++n) simulation->step(s.time.end);
  CHECK(simulation->stats().kinetic_energy > 0.4 * start);
}

// A rod of a third of a cell turns about its pinned end. Counted by mean velocities of faces, the liquid beside its
// middle carried almost nothing at first and thrice as much a step later.
TEST_CASE("elastic start: a rod below a cell that turns in liquid gains no energy", "[elastic][thin][long]") {
  Scene s = box_scene(3, 8);
  add_liquid(s, "y-0.8");
  s.time.end = 1;
  s.time.fixed_step = 2e-4;
  SolidSpec rod = elastic_solid("rod", 500, {3e5, 0.3}, 0.045);
  rod.shape.kind = "capsule";
  rod.shape.from = {0.45, 0.2, 0.47}, rod.shape.to = {0.55, 0.5, 0.56};
  rod.shape.radius = 0.0225;
  rod.rigid.velocity = {0.1, 0, 0};
  PinSpec root;
  root.shape.kind = "plane";
  root.shape.point = {0, 0.25, 0}, root.shape.normal = {0, 1, 0};
  rod.elastic.pinned.push_back(root);
  s.solids.push_back(rod);
  const auto simulation = make_simulation(s, Communicator());
  const double start = simulation->stats().kinetic_energy;
  for (int n = 0; n < 10; ++n) {
    const StepStats stats = simulation->step(s.time.end);
    CAPTURE(n);
    CHECK(stats.kinetic_energy + stats.elastic_energy <= start);
  }
}

}  // namespace elastic_start_tests
