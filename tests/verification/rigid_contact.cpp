// Friction, stacks and free rotation of bodies in the program's own step, against exact results.
#include <catch2/catch.hpp>
#include <random>

#include "base/scene.h"
#include "coupling/solids/kind_rigid.h"
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/step/initial_state.h"
#include "coupling/step/step.h"
#include "coupling/step/step_size.h"
#include "rigid_scenes.h"
#include "solid/rigid/motion.h"

namespace rigid_contact_tests {
using namespace seiche;

namespace {

constexpr double g = 9.81;
constexpr double gap = 0.0077;  // m: equilibrium of weight and barrier, so that bodies start without a bounce

// A flat body (so that it does not topple) just above a floor inclined by `degrees`; gravity is rotated instead.
Scene incline(int dim, double degrees, double friction) {
  Scene s = test::box_scene(dim, 16, 4);
  s.gravity = g * Vec3(std::sin(degrees * test::pi / 180), -std::cos(degrees * test::pi / 180), 0);
  s.time.max_step = 0.005;  // bodies move by v dt and feel friction after that: first order in dt
  const double z = dim == 3 ? 1 : 0;
  s.solids.push_back(test::rigid_box("block", {1, 0.2, z}, {0.8, 0.1 + gap, 2 * z}, 500));
  s.solids.back().friction = friction;
  return s;
}

double speed_after(const Scene& scene, double t) {
  const auto sim = make_simulation(scene, Communicator());
  while (sim->time() < t) (void)sim->step(t);
  return sim->solids()[0].velocity[0];
}

// Mean acceleration between two times after the block has come to rest on the floor.
double acceleration(Scene scene, double from, double until) {
  const auto sim = make_simulation(scene, Communicator());
  double first = 0;
  for (double t : {from, until}) {
    while (sim->time() < t) (void)sim->step(t);
    if (t == from) first = sim->solids()[0].velocity[0];
  }
  return (sim->solids()[0].velocity[0] - first) / (until - from);
}

}  // namespace

TEST_CASE("a block slides down an incline as Coulomb says", "[long]") {
  for (int dim : {2, 3})
    for (double mu : {0.0, 0.1, 0.3, 0.5}) {
      const double exact = g * (0.5 - mu * std::sqrt(0.75));
      const double error = acceleration(incline(dim, 30, mu), 0.2, 0.7) / exact - 1;
      WARN(dim << "D, friction " << mu << ": error " << error << ", bar 0.01");
      CHECK(std::abs(error) <= 0.01);
    }
}

TEST_CASE("a block sticks or slides on the right side of tan theta = mu", "[long]") {
  for (int dim : {2, 3})
    for (double mu : {0.1, 0.3, 1.0}) {
      const double angle = std::atan(mu) * 180 / test::pi;
      const double stuck = speed_after(incline(dim, angle, 1.02 * mu), 1);
      const double sliding = speed_after(incline(dim, angle, 0.98 * mu), 1);
      WARN(dim << "D, mu = " << mu << ": " << stuck << " m/s where it sticks, " << sliding << " m/s where it slides");
      CHECK(std::abs(stuck) <= 1e-3);  // creep: 1e-4 of the speed after a fall through one cell
      CHECK(sliding >= 0.5 * 0.02 * g * std::sin(angle * test::pi / 180));
    }
  CHECK(std::abs(speed_after(incline(2, 60, 1e6), 1)) <= 1e-3);
}

TEST_CASE("a block with a push comes to a stop where Coulomb says", "[long]") {
  for (int dim : {2, 3})
    for (double mu : {0.1, 0.3}) {
      const double v0 = std::sqrt(2 * mu * g);  // stops after 1 m
      Scene s = incline(dim, 0, mu);
      s.solids[0].rigid.velocity[0] = v0;
      const auto sim = make_simulation(s, Communicator());
      const double start = sim->solids()[0].position[0], until = 1.5 * v0 / (mu * g);
      while (sim->time() < until) (void)sim->step(until);
      const double way = sim->solids()[0].position[0] - start;
      WARN(dim << "D, mu = " << mu << ": stops after " << way << " m, exact 1 m, bar 0.01");
      CHECK(way == Approx(1).epsilon(0.01));
      CHECK(sim->solids()[0].velocity.norm() <= 1e-3);
    }
}

namespace {

enum class Around { air, water };

struct Stack {
  std::string name;
  int dimension;
  Around around;
  double density, top_density;
  double until;
};

// Ten cubes of four cells in a shaft, each slightly above the one below.
Scene stack_scene(const Stack& stack) {
  constexpr double side = 0.08;
  const bool solid = stack.dimension == 3;
  Scene s = test::box_scene(stack.dimension, 12, 0.24);
  s.domain.cells[1] = 48, s.domain.upper[1] = 0.96;
  s.gravity = {0, -g, 0};
  if (stack.around == Around::water) test::add_pool(s, 0.88);
  for (int k = 0; k < 10; ++k) {
    const Vec3 center(0.12, (k + 0.5) * side + (k + 1) * 5e-4, solid ? 0.12 : 0.0);
    s.solids.push_back(test::rigid_box(fmt::format("box{}", k), {side, side, solid ? side : 0.0}, center,
                                       k == 9 ? stack.top_density : stack.density));
    s.solids.back().friction = 0.4;
  }
  return s;
}

// Largest displacement of a box after the first second, over its side. The step size varies randomly; contact forces
// must not depend on it.
double creep(const Stack& stack, int& newton, int& steps) {
  const auto sim = make_simulation(stack_scene(stack), Communicator());
  std::vector<Vec3> settled;
  double farthest = 0;
  newton = steps = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> longest(std::log(0.01), std::log(0.04));
  while (sim->time() < stack.until) {
    newton += sim->step(sim->time() + std::exp(longest(random))).newton_iterations;
    ++steps;
    const auto now = sim->solids();
    if (sim->time() < 1) continue;
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (settled.size() < now.size()) settled.push_back(now[k].position);
      farthest = std::max(farthest, (now[k].position - settled[k]).norm());
    }
  }
  return farthest / 0.08;
}

}  // namespace

TEST_CASE("stacks of ten stand still", "[long]") {
  for (const Stack& stack :
       {Stack{"in air", 2, Around::air, 1500, 1500, 10}, Stack{"in air, 1e4:1 on top", 2, Around::air, 1500, 1.5e7, 10},
        Stack{"under water", 2, Around::water, 1500, 1500, 10},
        Stack{"under water, 1e4:1 on top", 2, Around::water, 1500, 1.5e7, 10},
        Stack{"3D in air", 3, Around::air, 1500, 1500, 2}}) {
    int newton, steps;
    const double way = creep(stack, newton, steps);
    WARN(stack.name << ": creep " << way << " of a box in " << stack.until << " s, bar 0.01 (" << newton
                    << " Newton iterations in " << steps << " steps)");
    CHECK(way <= 0.01);
  }
}

// Edges 0.2, 0.3, 0.4: free rotation about the middle axis (that of 0.3) is unstable, so the body flips repeatedly.
TEST_CASE("a body that spins about its middle axis keeps energy and angular momentum over 100 turns", "[long]") {
  Scene s = test::box_scene(3, 8);
  s.gravity = Vec3::Zero();
  s.solids.push_back(test::rigid_box("box", {0.2, 0.3, 0.4}, {0.5, 0.5, 0.5}, 700));
  s.solids[0].rigid.angular_velocity = {0.01, 2 * test::pi, 0.02};
  const Setup<3> setup(s, Communicator());
  const PrincipalInertia inertia = principal_inertia(setup.solids.bodies[0].mass().inertia);
  const auto energy = [&](const RigidState& r) {
    return 0.5 * r.angular_momentum.dot(angular_velocity(inertia, r.rotation, r.angular_momentum));
  };
  State<3> state = initial_state(setup);
  const double energy0 = energy(*state.solids[0].rigid()), momentum0 = state.solids[0].rigid()->angular_momentum.norm();
  double energy_error = 0, momentum_error = 0, flips = 1;
  Phases phases;
  for (int n = 0; state.time < 100; ++n) {
    // Step sizes vary by up to a fifth, and every seventh step is halved.
    const double share = n % 7 == 0 ? 0.5 : 0.9 + 0.1 * std::sin(n);
    Attempt<3> attempt = attempt_step(setup, state, share * choose_step(setup, state, state.time + 10), phases);
    REQUIRE(attempt.failure.empty());
    state = std::move(attempt.state);
    const RigidState& r = *state.solids[0].rigid();
    energy_error = std::max(energy_error, std::abs(energy(r) / energy0 - 1));
    momentum_error = std::max(momentum_error, std::abs(r.angular_momentum.norm() / momentum0 - 1));
    flips = std::min(flips, r.rotation(1, 1));
  }
  WARN("energy within " << energy_error << ", |L| within " << momentum_error << " (bar 0.01) in " << state.step
                        << " steps; turned over as far as cos = " << flips);
  CHECK(energy_error <= 0.01);
  CHECK(momentum_error <= 0.01);
  CHECK(flips < -0.9);
}

}  // namespace rigid_contact_tests
