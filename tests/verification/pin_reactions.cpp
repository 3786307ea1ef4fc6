// Forces that pins exert on elastic solids, against balances of forces and of momentum.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "elastic_scenes.h"
#include "rigid_scenes.h"

namespace pin_reactions_tests {
using namespace seiche;
using namespace seiche::test;

namespace {

constexpr double g = 9.81;

// A point; z counts in 3D only.
Vec3 corner(int dim, double x, double y, double z) {
  return {x, y, dim == 3 ? z : 0};
}

Scene tank(int dim, double gravity) {
  Scene s = box_scene(dim, dim == 2 ? 20 : 10);
  s.gravity = {0, -gravity, 0};
  s.solver.tolerance = 1e-12;
  return s;
}

// A block from `low` to `high` with all nodes pinned.
SolidSpec pinned_block(const Vec3& low, const Vec3& high, double density, double element) {
  SolidSpec s = elastic_box("block", low, high, density, {1e6, 0.3}, element);
  pin(s, low - Vec3::Constant(0.01), high + Vec3::Constant(0.01));
  return s;
}

std::unique_ptr<Simulation> run(const Scene& scene, int steps) {
  auto sim = make_simulation(scene, Communicator());
  for (int n = 0; n < steps; ++n) (void)sim->step(sim->time() + 1);
  return sim;
}

// A cantilever clamped on the left; in 3D 0.2 m deep.
Scene cantilever(int dim, double gravity) {
  Scene s = tank(dim, gravity);
  s.solids.push_back(
      elastic_box("bar", corner(dim, 0.1, 0.45, 0.4), corner(dim, 0.7, 0.6, 0.6), 1200, {1e6, 0.3}, 0.15));
  pin(s.solids.back(), {0, 0, -1}, {0.101, 1, 1});
  s.time.scheme = TimeScheme::first_order;
  return s;
}
double mass_of_cantilever(int dim) {
  return 1200 * 0.6 * 0.15 * (dim == 3 ? 0.2 : 1);
}

// Largest difference between m dV/dt (V: velocity of the centre of mass) and the sum of forces, relative to the largest
// of either. In the first-order scheme the V of each row belongs to the end of the next step; dt is fixed.
double imbalance(Scene s, double mass, int steps) {
  const double dt = 0.002;
  s.time.fixed_step = dt;
  s.time.frame_rate = 1 / dt;
  const auto sim = make_simulation(s, Communicator());
  double worst = 0, largest = 0;
  for (int n = 0; n < steps; ++n) {
    const Vec3 before = sim->solids()[0].velocity;
    (void)sim->step(sim->time() + dt);
    const SolidState bar = sim->solids()[0];
    if (n == 0) continue;  // before the first solve the velocity is not that of a solve
    const Vec3 rate = mass * (bar.velocity - before) / dt;
    worst = std::max(worst, (rate - bar.pin_force - bar.force - mass * Vec3(0, -g, 0)).norm());
    largest = std::max({largest, rate.norm(), bar.pin_force.norm()});
  }
  return worst / largest;
}

}  // namespace

TEST_CASE("the pins of a body that hangs at rest carry its weight", "[elastic]") {
  for (int dim : {2, 3}) {
    Scene s = tank(dim, g);
    s.solids.push_back(
        elastic_box("bar", corner(dim, 0.4, 0.3, 0.4), corner(dim, 0.6, 0.9, 0.6), 1200, {1e6, 0.3}, 0.2));
    pin(s.solids.back(), {0, 0.899, -1}, {1, 1, 1});
    s.time.scheme = TimeScheme::first_order;
    s.time.fixed_step = 0.05;  // damps oscillations by a factor of two to five per step
    const SolidState bar = run(s, 60)->solids()[0];
    const double weight = 1200 * g * 0.12 * (dim == 3 ? 0.2 : 1);
    WARN(dim << "D: " << bar.pin_force.transpose() << " N, weight " << weight << ", bar 1e-6");
    CHECK((bar.pin_force - Vec3(0, weight, 0)).norm() <= 1e-6 * weight);
    CHECK(bar.pin_torque.norm() <= 1e-6 * weight);
    CHECK(bar.force.norm() == 0);
  }
}

TEST_CASE("pins balance force and moment of a load at the free end", "[elastic]") {
  for (int dim : {2, 3}) {
    Scene s = cantilever(dim, 0);
    TractionSpec load;
    load.shape.kind = "box";
    load.shape.where = "test";
    load.shape.lower = {0.699, 0, -1};
    load.shape.upper = {1, 1, 1};
    load.stress = {"0.0", "200.0", dim == 3 ? "100.0" : "0.0"};  // Pa, on 0.15 (by 0.2) of the side x = 0.7
    s.solids.back().elastic.tractions.push_back(load);
    s.time.frame_rate = 10;
    s.time.fixed_step = 0.1;  // damps the slowest oscillation, of 12/s, by a factor of 0.6 per step
    const SolidState bar = run(s, 60)->solids()[0];
    const Vec3 force = 0.15 * (dim == 3 ? 0.2 : 1) * Vec3(0, 200, dim == 3 ? 100 : 0);
    // The bar bends by 8 mm, which changes the load's arm about the centre of mass (0.3 m at rest) by less than 1 %.
    const Vec3 moment = Vec3(0.3, 0, 0).cross(force);
    WARN(dim << "D: " << bar.pin_force.transpose() << " N, load " << force.transpose() << "; "
             << bar.pin_torque.transpose() << " N m, load " << moment.transpose() << "; bars 1e-6 and 0.01");
    CHECK((bar.pin_force + force).norm() <= 1e-6 * force.norm());
    CHECK((bar.pin_torque + moment).norm() <= 0.01 * moment.norm());
  }
}

// Faces of the block coincide with cell faces, so the grid has its volume to round-off.
TEST_CASE("the pins of a body in still liquid carry its weight less its buoyancy", "[elastic]") {
  for (int dim : {2, 3}) {
    Scene s = tank(dim, g);
    add_liquid(s, "y - 0.83");
    s.solids.push_back(pinned_block(corner(dim, 0.3, 0.2, 0.3), corner(dim, 0.6, 0.5, 0.7), 1500, 0.17));
    s.time.fixed_step = 0.005;
    const SolidState block = run(s, 3)->solids()[0];
    const double weight = (1500 - 1000) * g * 0.09 * (dim == 3 ? 0.4 : 1);
    WARN(dim << "D: " << block.pin_force.transpose() << " N, weight in liquid " << weight << ", bar 1e-6");
    CHECK((block.pin_force - Vec3(0, weight, 0)).norm() <= 1e-6 * weight);
    CHECK(block.pin_torque.norm() <= 1e-6 * weight);
  }
}

// The block reaches through the floor, so nothing presses on it from below.
TEST_CASE("the pins of a block in the floor under a uniform pressure p carry p times its top", "[elastic]") {
  for (int dim : {2, 3}) {
    Scene s = tank(dim, 0);
    add_liquid(s, "-1");
    s.domain.sides[1][1] = {SideType::outflow, {"0", "0", "0"}, "300"};
    s.solids.push_back(pinned_block(corner(dim, 0.3, -0.1, 0.3), corner(dim, 0.6, 0.3, 0.7), 1500, 0.17));
    s.time.fixed_step = 0.005;
    const SolidState block = run(s, 3)->solids()[0];
    const double load = 300 * 0.3 * (dim == 3 ? 0.4 : 1);
    WARN(dim << "D: " << block.pin_force.transpose() << " N, load " << load << ", bar 1e-6");
    CHECK((block.pin_force - Vec3(0, load, 0)).norm() <= 1e-6 * load);
  }
}

TEST_CASE("the pins of a body that liquid flows past hold against weight and liquid", "[elastic]") {
  const std::vector<std::pair<const char*, ViscousSolve>> liquids{
      {"0.0", ViscousSolve::automatic}, {"0.1", ViscousSolve::split}, {"5.0", ViscousSolve::coupled}};
  for (int dim : {2, 3})
    for (const auto& [viscosity, route] : liquids) {
      Scene s = tank(dim, g);
      add_liquid(s, "y - 0.83");
      s.liquid.velocity = {"1.0", "0.0", "0.0"};
      s.liquid.viscosity = viscosity;
      s.solver.viscosity = route;
      s.solids.push_back(pinned_block(corner(dim, 0.32, 0.23, 0.33), corner(dim, 0.63, 0.51, 0.67), 1500, 0.17));
      s.solids.back().slip = Slip::no_slip;
      s.time.fixed_step = 0.005;
      const SolidState block = run(s, 3)->solids()[0];
      const Vec3 weight(0, -1500 * g * 0.31 * 0.28 * (dim == 3 ? 0.34 : 1), 0);
      const double error = (block.pin_force + block.force + weight).norm() / weight.norm();
      WARN(dim << "D, viscosity " << viscosity << ": " << block.pin_force.transpose() << " N, liquid "
               << block.force.transpose() << " N, sum with the weight " << error << " of it, bar 1e-10");
      CHECK(error <= 1e-10);
      CHECK(std::abs(block.force[0]) > 1e-5 * weight.norm());  // ideal liquid has next to no drag
    }
}

TEST_CASE("pins, weight and liquid change the momentum of a bar that swings", "[elastic][long]") {
  for (int dim : {2, 3})
    for (const char* around : {"air", "liquid", "viscous liquid"}) {
      Scene s = cantilever(dim, g);
      s.solids.back().elastic.pinned.back().motion.translate = {"0.0", "0.01*sin(40*t)", "0.0"};
      if (around != std::string("air")) add_liquid(s, "y - 0.8");
      if (around == std::string("viscous liquid")) s.liquid.viscosity = "500.0";
      const double error = imbalance(s, mass_of_cantilever(dim), dim == 2 ? 40 : 10);
      WARN(dim << "D in " << around << ": imbalance over the largest force " << error << ", bar 1e-8");
      CHECK(error <= 1e-8);
    }
}

TEST_CASE("the pins of a block carry what rests on it", "[elastic][long]") {
  for (int dim : {2, 3}) {
    Scene s = tank(dim, g);
    s.solids.push_back(pinned_block(corner(dim, 0.3, 0.1, 0.3), corner(dim, 0.7, 0.3, 0.7), 1500, 0.2));
    const double z = dim == 3 ? 0.5 : 0;
    s.solids.push_back(rigid_box("box", {0.2, 0.2, dim == 3 ? 0.2 : 0}, {0.5, 0.403, z}, 500));
    s.time.max_step = 0.005;
    const SolidState block = run(s, 200)->solids()[0];
    const double weight = g * (dim == 3 ? 1500 * 0.4 * 0.4 * 0.2 + 500 * 0.008 : 1500 * 0.08 + 500 * 0.04);
    WARN(dim << "D: " << block.pin_force.transpose() << " N, weights " << weight << ", bar 1e-4");
    CHECK((block.pin_force - Vec3(0, weight, 0)).norm() <= 1e-4 * weight);
  }
}

}  // namespace pin_reactions_tests
