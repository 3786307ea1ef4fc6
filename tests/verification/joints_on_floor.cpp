// Joints and contact in one solve: iterations.
#include <catch2/catch.hpp>

#include "joint_scenes.h"

namespace joints_on_floor_tests {
using namespace seiche;
using test::hinge;

namespace {

constexpr int boxes = 8;

// Boxes side by side that fall onto a floor and slide on it, joined or not. With a step on the floor, those beside it
// hang on the others if they are joined.
Scene fallen(int dimension, bool jointed, bool with_step) {
  Scene s = test::box_scene(dimension, 24, 2.4);
  s.gravity = Vec3(0, -9.81, 0);
  const double z = dimension == 3 ? 1.2 : 0, y = with_step ? 0.7 : 0.52;
  SolidSpec floor = test::rigid_box("floor", {3, 0.4, 3}, {1.2, 0.2, z}, 1);
  SolidSpec step = test::rigid_box("step", {0.6, 0.2, 3}, {1.2, 0.45, z}, 1);
  floor.kind = step.kind = SolidKind::fixed;
  s.solids = {floor};
  if (with_step) s.solids.push_back(step);
  for (int k = 0; k < boxes; ++k) {
    const double x = 0.15 + 0.3 * k;
    s.solids.push_back(test::rigid_box(fmt::format("box{}", k), {0.24, 0.2, 0.3}, {x, y, z}, 500));
    if (!with_step) s.solids.back().rigid.velocity = Vec3(0.2, 0, 0);
    if (jointed && k > 0)
      s.joints.push_back(hinge(fmt::format("pin{}", k), fmt::format("box{}", k), fmt::format("box{}", k - 1),
                               {x - 0.15, y, z}, Vec3(0, 0, dimension == 3 ? 1 : 0)));
  }
  for (SolidSpec& solid : s.solids) solid.friction = 0.4;
  s.time.max_step = 0.005;
  return s;
}

struct NewtonCount {
  int iterations = 0, steps = 0, turns = 0;
  double mean() const { return double(iterations) / std::max(steps, 1); }
};

// Iterations of the steps with contact.
NewtonCount count_newton(const Scene& s, double end) {
  const auto sim = make_simulation(s, Communicator());
  NewtonCount count;
  while (sim->time() < end * (1 - 1e-12)) {
    const StepStats stats = sim->step(end);
    if (stats.contacts == 0) continue;
    ++count.steps;
    count.iterations += stats.newton_iterations;
    count.turns += stats.joint_turns;
  }
  return count;
}

}  // namespace

// Bar: 1.3 times as many Newton iterations as without joints, in the same contacts. Boxes that hang over a step touch
// in other places than loose ones, which come to rest.
TEST_CASE("joints: contact takes hardly more Newton iterations with joints", "[joints][long]") {
  for (const int dim : {2, 3})
    for (const bool with_step : {false, true}) {
      const double end = dim == 2 ? 0.6 : 0.3;
      const NewtonCount loose = count_newton(fallen(dim, false, with_step), end),
                        jointed = count_newton(fallen(dim, true, with_step), end);
      WARN(dim << (with_step ? "D, with a step: " : "D: ") << loose.mean() << " iterations a step loose, "
               << jointed.mean() << " jointed, with " << double(jointed.turns) / std::max(jointed.steps, 1)
               << " turns");
      REQUIRE(loose.steps > 20);
      REQUIRE(jointed.steps > 20);
      CHECK(jointed.mean() <= (with_step ? 3 : 1.3) * loose.mean());  // 1.295, 1.23; 2.4, 2.8
    }
}

// A chain of forty links, held at one end and let go from the horizontal, whips through the air and onto the floor.
// When bows of its path that do not close were taken in one turn and left out in the next, 54 steps were refused.
TEST_CASE("joints: a chain that whips onto the floor closes in few turns", "[joints]") {
  constexpr int links = 40;
  Scene s = test::box_scene(3, 90, 9);
  s.domain.lower[0] = -0.5, s.domain.upper[0] = 8.5;
  s.domain.upper[1] = 2, s.domain.cells[1] = 20;
  s.domain.upper[2] = 0.8, s.domain.cells[2] = 8;
  s.gravity = Vec3(0, -9.8, 0);
  for (int k = 0; k < links; ++k) {
    s.solids.push_back(test::rigid_box(fmt::format("link{}", k), {0.18, 0.18, 0.18}, {0.2 * k + 0.1, 1.6, 0.4}, 1000));
    s.joints.push_back(hinge(fmt::format("pin{}", k), s.solids.back().name,
                             k == 0 ? "world" : fmt::format("link{}", k - 1), {0.2 * k, 1.6, 0.4}, Vec3(0, 0, 1)));
  }
  s.time.fixed_step = 0.005;
  s.time.frame_rate = 1;
  const auto sim = make_simulation(s, Communicator());
  int refused = 0, turns = 0;
  while (sim->time() < 0.7 * (1 - 1e-12)) {
    const StepStats stats = sim->step(0.7);
    refused += stats.rejected, turns = std::max(turns, stats.joint_turns);
  }
  WARN(refused << " steps refused, at most " << turns << " turns");
  CHECK(refused <= 6);  // measured: 3, of an impact at 30 m/s
  CHECK(turns <= 4);    // 2; were 9
}

}  // namespace joints_on_floor_tests
