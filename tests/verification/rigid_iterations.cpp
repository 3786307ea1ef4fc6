// Cost of solves with rigid bodies: iterations at any density ratio and number of ranks, set-up for many bodies.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "first_solve.h"
#include "rigid_scenes.h"

namespace rigid_iterations_tests {
using namespace seiche;

namespace {

Scene tank(int cells) {
  Scene s = test::box_scene(3, cells);
  s.gravity = {0, -9.81, 0};
  test::add_pool(s, 0.8);
  return s;
}

Scene one_sphere(int cells, double ratio) {
  Scene s = tank(cells);
  s.solids.push_back(test::rigid_ball("ball", 0.2, {0.5, 0.42, 0.5}, 1000 * ratio));
  return s;
}

// 27 balls of density ratio 1e-6 to 1e-1.
Scene many_spheres(int cells) {
  Scene s = tank(cells);
  s.liquid.regions[0].shape.upper[1] = 0.95;
  for (int n = 0; n < 27; ++n) {
    const Vec3 center(0.2 + 0.3 * (n % 3), 0.17 + 0.3 * (n / 9), 0.2 + 0.3 * (n / 3 % 3));
    s.solids.push_back(test::rigid_ball(fmt::format("ball{}", n), 0.1, center, 1000 * std::pow(10, -6 + 5.0 * n / 26)));
  }
  return s;
}

// Eight balls, all within two cells of a side along x and z.
Scene spheres_at_sides(SideType sides) {
  Scene s = tank(32);
  for (const int a : {0, 2})
    for (SideSpec& side : s.domain.sides[a]) side.type = sides;
  for (int n = 0; n < 8; ++n) {
    const Vec3 center(n % 2 ? 0.83 : 0.17, n / 4 ? 0.6 : 0.25, n / 2 % 2 ? 0.83 : 0.17);
    s.solids.push_back(test::rigid_ball(fmt::format("ball{}", n), 0.12, center, 1));
  }
  return s;
}

struct Effort {
  int coupled = 0;  // iterations with free bodies
  int fixed = 0;    // iterations with fixed bodies
  int setup = 0;    // applications of the preconditioner before the first iteration
};

Effort measure(const Scene& scene) {
  test::FirstSolve f(scene);
  REQUIRE(f.problem.minimise(SparseMatrix(0, 0), Eigen::VectorXd::Zero(f.problem.size())).failure.empty());
  Effort e{f.problem.report().iterations, 0, f.solver.setup_applications()};
  Vector still(f.b.size());
  const SolveReport fixed = f.solver.solve(BodyMatrix(f.s.domain.ranks), f.b, still);
  REQUIRE(fixed.converged);
  e.fixed = fixed.iterations;
  return e;
}

void check_ratios(std::initializer_list<int> grids) {
  int least = 1000, most = 0;
  for (int cells : grids)
    for (double ratio : {1e-6, 1e-3, 1.0, 1e3}) {
      const Effort e = measure(one_sphere(cells, ratio));
      if (Communicator().is_root())
        WARN(cells << "^3, ratio " << ratio << ": " << e.coupled << " iterations, held " << e.fixed << ", set-up "
                   << e.setup << " cycles");
      least = std::min(least, e.coupled), most = std::max(most, e.coupled);
    }
  CHECK(most <= 12);
  CHECK(most - least <= 3);
}

}  // namespace

TEST_CASE("iterations do not depend on the density of a sphere", "[ranks][long]") {
  check_ratios({32, 64});
}

TEST_CASE("iterations do not depend on the density of a sphere in 96^3 cells", "[long]") {
  check_ratios({96});
}

TEST_CASE("light spheres beside periodic sides cost no more iterations than beside walls", "[ranks]") {
  const Effort walls = measure(spheres_at_sides(SideType::free_slip));
  const Effort periodic = measure(spheres_at_sides(SideType::periodic));
  if (Communicator().is_root())
    WARN(periodic.coupled << " iterations, beside walls " << walls.coupled << "; held " << periodic.fixed << ", "
                          << walls.fixed);
  CHECK(periodic.coupled <= walls.coupled + 5);
}

TEST_CASE("27 light spheres cost three static solves to set up and thirty iterations", "[ranks][long]") {
  const Effort e = measure(many_spheres(64));
  if (Communicator().is_root())
    WARN(e.coupled << " iterations (bar 30), set-up " << e.setup << " cycles, static solve " << e.fixed
                   << " iterations (bar 3 of it)");
  CHECK(e.coupled <= 30);
  CHECK(e.setup <= 3 * e.fixed);
}

}  // namespace rigid_iterations_tests
