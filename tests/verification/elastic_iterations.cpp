// Cost of solves with elastic bodies: iterations at any stiffness, density and resolution.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "elastic_scenes.h"
#include "first_solve.h"
#include "rigid_scenes.h"

namespace elastic_iterations_tests {
using namespace seiche;

namespace {

// A fully submerged block in the middle of a pool.
Scene immersed_block(int cells, double youngs_modulus, double ratio) {
  Scene s = test::box_scene(3, cells);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.8);
  SolidSpec block;
  block.name = "block";
  block.kind = SolidKind::elastic;
  block.shape.kind = "box";
  block.shape.lower = {0.3, 0.25, 0.35};
  block.shape.upper = {0.7, 0.55, 0.65};
  block.shape.where = "test";
  block.rigid.density = 1000 * ratio;
  block.elastic.youngs_modulus = youngs_modulus;
  block.elastic.poisson_ratio = 0.4;
  block.elastic.element_size = 0.05;
  s.solids.push_back(block);
  return s;
}

enum class Route { factor, together };

struct FirstStep {
  int iterations;
  Eigen::VectorXd velocity;
};

// Solves the first Newton step.
FirstStep first_step(const Scene& scene, Route route = Route::factor) {
  test::FirstSolve f(scene);
  const NullSpace closed = find_closed_components(f.in, f.rows);
  KktSolver kkt({f.A, f.grid, closed, f.coupling.J, f.c1, f.c2, 3}, {.tolerance = 1e-8}, f.s.domain.ranks);
  if (route == Route::together) f.problem.solve_together(kkt);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(f.coupling.size());
  Eigen::VectorXd gradient = rest;
  f.coupling.potential->add_gradient(rest, gradient);
  const SparseMatrix K = f.coupling.potential->hessian(rest, HessianProjection::exact, f.problem.columns());
  const InertiaResponse response = f.problem.minimise(K, -gradient);
  INFO(response.failure);
  REQUIRE(response.failure.empty());
  REQUIRE(response.shape == Shape::convex);
  CHECK(f.problem.report().failed_attempts.empty());
  return {f.problem.report().iterations, response.velocity};
}

void check_block(int cells) {
  const std::array<std::pair<double, int>, 3> bars{{{1, 12}, {0.1, 14}, {0.01, 24}}};
  for (const auto& [ratio, bar] : bars)
    for (const double E : {1e3, 1e5, 1e7, 1e9}) {
      const int n = first_step(immersed_block(cells, E, ratio)).iterations;
      if (Communicator().is_root())
        WARN(cells << "^3, ratio " << ratio << ", E " << E << ": " << n << " iterations (bar " << bar << ")");
      // Known misses (docs/decisions/0027): 31 in 64^3 cells, 25 in 48^3 cells on several ranks.
      const bool known_miss = ratio == 0.01 && E == 1e3;
      CHECK(n <= (!known_miss ? bar : cells == 64 ? 31 : 25));
    }
}

}  // namespace

TEST_CASE("iterations depend little on the stiffness and density of an immersed block", "[elastic][ranks][long]") {
  check_block(32);
  check_block(48);
}

TEST_CASE("iterations depend little on the stiffness and density of an immersed block in 64^3 cells",
          "[elastic][long]") {
  check_block(64);
}

TEST_CASE("without factors of the block iterations depend little on stiffness and density either", "[elastic][long]") {
  const std::array<std::pair<double, int>, 3> bars{{{1, 50}, {0.1, 55}, {0.01, 70}}};
  for (const int cells : {24, 48})
    for (const auto& [ratio, bar] : bars)
      for (const double E : {1e3, 1e5, 1e7, 1e9}) {
        const FirstStep together = first_step(immersed_block(cells, E, ratio), Route::together);
        if (Communicator().is_root())
          WARN(cells << "^3, ratio " << ratio << ", E " << E << ": " << together.iterations
                     << " iterations together (bar " << bar << ")");
        CHECK(together.iterations <= bar);
        if (cells > 24) continue;
        const Eigen::VectorXd exact = first_step(immersed_block(cells, E, ratio)).velocity;
        // Both solve to 1e-8 of the forces; the velocities of the stiffest block are small differences of these.
        CHECK((together.velocity - exact).norm() <= 1e-5 * exact.norm());
      }
}

TEST_CASE("a run without factors follows the run with them, in contact too", "[elastic][long]") {
  const int dim = GENERATE(2, 3);
  Scene scene = test::box_scene(dim, dim == 2 ? 24 : 12);
  scene.gravity = {0, -9.81, 0};
  test::add_pool(scene, 0.6);
  const double z = dim == 3 ? 1 : 0;
  scene.solids = {test::elastic_box("lower", {0.3, 0.001, 0.3 * z}, {0.7, 0.25, 0.7 * z}, 1200, {1e4, 0.3}, 0.1),
                  test::elastic_box("upper", {0.35, 0.255, 0.35 * z}, {0.65, 0.5, 0.65 * z}, 3000, {1e5, 0.3}, 0.1)};
  scene.time.fixed_step = 5e-3;
  scene.solver.tolerance = 1e-12;  // contact amplifies residuals: 1e-8 and 1e-10 give differences of 1.8e-4 and 1.5e-4
  const auto run = [&](const char* route) {
    scene.solver.elastic = route;
    const auto sim = make_simulation(scene, Communicator());
    std::vector<StepStats> steps;
    for (int n = 0; n < 8; ++n) steps.push_back(sim->step(1e3));
    return steps;
  };
  const auto with = run("factor"), without = run("iterate");
  bool differ = false;
  int touching = 0;
  for (std::size_t n = 0; n < with.size(); ++n) {
    CAPTURE(dim, n, with[n].solver_iterations, without[n].solver_iterations);
    // One step contributes less than a thousandth of these energies.
    CHECK(without[n].kinetic_energy == Approx(with[n].kinetic_energy).epsilon(1e-4));
    CHECK(without[n].elastic_energy == Approx(with[n].elastic_energy).epsilon(1e-4));
    differ = differ || with[n].solver_iterations != without[n].solver_iterations;
    touching += with[n].contacts > 0;
  }
  CHECK(differ);  // the key has an effect
  CHECK(touching > 0);
}

// Straight Newton steps stretch a body that turns, and a stiff one allows little of that: 77 to 99 iterations a step.
TEST_CASE("a stiff ball that turns by 0.4 rad a step takes few Newton iterations") {
  for (int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 10, 2);
    s.time.fixed_step = 0.05;
    s.solids.push_back(test::elastic_solid("ball", 100, {1e9, 0.3}, 0.1));
    s.solids[0].shape.kind = "sphere";
    s.solids[0].shape.center = {1, 1, dim == 3 ? 1.0 : 0.0};
    s.solids[0].shape.radius = 0.19;
    s.solids[0].rigid.angular_velocity = dim == 3 ? Vec3(5, 5, 4) : Vec3(0, 0, 8);
    const auto sim = make_simulation(s, Communicator());
    int most = 0;
    for (int n = 0; n < 4; ++n) most = std::max(most, sim->step(1).newton_iterations);
    WARN(dim << "D: at most " << most << " iterations");
    CHECK(most <= 12);  // 8 and 9 found, in the first step; 4 later
  }
}

}  // namespace elastic_iterations_tests
