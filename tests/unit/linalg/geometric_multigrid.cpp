// Multigrid of our own as a preconditioner of conjugate gradients. Counts of iterations are those measured plus two.
#include "linalg/precond/geometric_multigrid.h"

#include <catch2/catch.hpp>

#include "base/thread_limit.h"
#include "linalg/core/linear_system.h"
#include "linalg/krylov/krylov.h"
#include "unit/linalg/cases.h"

namespace geometric_multigrid_tests {
using namespace seiche;
using cases::Cell;
using cases::Kind;

namespace {

struct Projected {
  Preconditioner& preconditioner;
  const LinearSystem& system;
  void apply(const Vector& r, Vector& z) {
    preconditioner.apply(r, z);
    system.project(z);
  }
};

struct Solved {
  int iterations = 0;
  Vector x;
};

// To |r| <= 1e-8 |b|, from x = 0.
Solved solve(const cases::System& s, const MultigridSettings& settings = {}) {
  const Communicator ranks;
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  const auto made = make_geometric_multigrid(system, settings);
  INFO(made.failure);
  REQUIRE(made.preconditioner);
  Projected B{*made.preconditioner, system};
  Vector b(std::size_t(system.rows())), r(b.size());
  system.multiply(cases::noise_vector(s.A, 5), b);
  system.project(b);
  Solved solved{0, Vector(b.size(), 0.0)};
  const double size = norm(b, ranks);
  const auto result = conjugate_gradients(system, B, b, solved.x, {1e-8 * size, 100}, ranks);
  CHECK(result.failure == "");
  system.residual(b, solved.x, r);
  CHECK(norm(r, ranks) <= 2e-8 * size);
  solved.iterations = result.iterations;
  return solved;
}

cases::Poisson box(int dimension, std::array<int, 3> size, Kind outside) {
  cases::Poisson p;
  p.dimension = dimension;
  p.size = size;
  p.outside = outside;
  return p;
}

cases::Poisson splash(int n) {
  const std::array<int, 3> size{n, n, n};
  cases::Poisson p = box(3, size, Kind::wall);
  p.kind = [size](Cell c) { return cases::splash(size, c); };
  p.weight = [size](Cell c, int axis) { return cases::cut_weight(size, c, axis); };
  return p;
}

// 1000:1 at half the height, harmonic mean between.
cases::Poisson two_fluids(int n) {
  cases::Poisson p = box(3, {n, n, n}, Kind::wall);
  p.weight = [n](Cell c, int axis) { return 2 * c[1] < n ? 1.0 : axis == 1 && 2 * (c[1] - 1) < n ? 2.0 : 1000.0; };
  return p;
}

cases::Poisson pores(int dimension, std::array<int, 3> size) {
  cases::Poisson p = box(dimension, size, Kind::wall);
  p.kind = [](Cell c) { return cases::noise(c[0] + 1000 * (c[1] + 1000 * c[2])) < -0.5 ? Kind::wall : Kind::liquid; };
  return p;
}

// Plates without thickness, with a hole in one corner, at an odd number of cells: both sides are in one coarse cell.
cases::Poisson plates(int n) {
  cases::Poisson p = box(3, {n, n, n}, Kind::wall);
  p.weight = [n](Cell c, int axis) {
    const bool plate = axis == 0 && (c[0] == 5 || c[0] == 11 || c[0] == 19);
    return plate && (c[1] > n / 4 || c[2] > n / 4) ? 0.0 : 1.0;
  };
  return p;
}

}  // namespace

TEST_CASE("Geometric multigrid is symmetric and positive") {
  const int dimension = GENERATE(2, 3);
  const Kind outside = GENERATE(Kind::air, Kind::wall);
  cases::Poisson p = box(dimension, {17, 13, dimension == 3 ? 11 : 1}, outside);
  SECTION("whole box") {}
  SECTION("pores") {
    p = pores(dimension, p.size);
  }
  SECTION("periodic, odd") {
    p.periodic = {1, 0, 0};
  }
  const Communicator ranks;
  const cases::System s = cases::build(p, ranks);
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  const auto made = make_geometric_multigrid(system, {.gathered_cells = 100});
  REQUIRE(made.preconditioner);
  Projected B{*made.preconditioner, system};
  for (int seed = 0; seed < 5; ++seed) {
    Vector u = cases::noise_vector(s.A, 2 * seed), v = cases::noise_vector(s.A, 2 * seed + 1), Bu(u.size()),
           Bv(u.size());
    system.project(u);
    system.project(v);
    B.apply(u, Bu);
    B.apply(v, Bv);
    const double size = std::sqrt(dot(u, Bu, ranks) * dot(v, Bv, ranks));
    CHECK(dot(u, Bu, ranks) > 0);
    CHECK(std::abs(dot(u, Bv, ranks) - dot(v, Bu, ranks)) <= 1e-5 * size);
  }
}

TEST_CASE("Geometric multigrid keeps its iterations as grids are refined") {
  const auto at = [](const cases::Poisson& p) { return solve(cases::build(p, Communicator())).iterations; };
  CHECK(at(splash(16)) <= 11);
  CHECK(at(splash(32)) <= 11);
  CHECK(at(two_fluids(16)) <= 11);
  CHECK(at(two_fluids(32)) <= 11);
  CHECK(at(plates(24)) <= 17);
  CHECK(at(pores(3, {24, 24, 24})) <= 22);
  CHECK(at(pores(2, {60, 60, 1})) <= 30);
}

TEST_CASE("Geometric multigrid takes boxes of any size, closed, open and periodic") {
  const std::array<int, 3> size =
      GENERATE(std::array{33, 17, 40}, std::array{17, 13, 11}, std::array{31, 31, 31}, std::array{3, 40, 5});
  const Kind outside = GENERATE(Kind::air, Kind::wall);
  const std::array<int, 3> periodic = GENERATE(std::array{0, 0, 0}, std::array{1, 0, 0}, std::array{0, 1, 1});
  cases::Poisson p = box(3, size, outside);
  p.periodic = periodic;
  CAPTURE(size, periodic, outside == Kind::air);
  CHECK(solve(cases::build(p, Communicator())).iterations <= 12);
  p.dimension = 2;
  p.size[2] = 1;
  p.periodic[2] = 0;
  CHECK(solve(cases::build(p, Communicator())).iterations <= 13);
}

TEST_CASE("Geometric multigrid leaves rows without an equation alone") {
  cases::Poisson p = box(3, {12, 12, 12}, Kind::air);
  p.weight = [](Cell c, int axis) {  // cell (5, 5, 5) has no open face
    const Cell high{5 + (axis == 0), 5 + (axis == 1), 5 + (axis == 2)};
    return c == Cell{5, 5, 5} || c == high ? 0.0 : 1.0;
  };
  CHECK(solve(cases::build(p, Communicator())).iterations <= 11);
}

TEST_CASE("Geometric multigrid gives the same bits on any number of threads") {
  const cases::System s = cases::build(splash(32), Communicator());
  const auto on = [&](int threads) {
    const ThreadLimit limit(threads);
    return solve(s).x;
  };
  CHECK(on(1) == on(3));
}

TEST_CASE("Geometric multigrid needs as many iterations on levels that are spread over ranks") {
  const cases::System s = cases::build(splash(32), Communicator());
  const int gathered = solve(s).iterations, spread = solve(s, {.gathered_cells = 500}).iterations;
  CHECK(std::abs(gathered - spread) <= 2);
}

}  // namespace geometric_multigrid_tests
