#include <catch2/catch.hpp>

#include "base/error.h"
#include "linalg/core/linear_system.h"
#include "linalg/spd/solve.h"
#include "lu_solves.h"
#include "unit/linalg/cases.h"

namespace solve_tests {
using namespace seiche;
using cases::Cell;
using cases::Kind;

namespace {

// |b - A x| / |b| by sums over the entries of A, with x and b known on every rank, without code of src/linalg.
double residual_by_hand(const DistributedMatrix& A, const Vector& b, const Vector& x, const Communicator& ranks) {
  Vector all(A.global_rows, 0.0);
  std::copy(x.begin(), x.end(), all.begin() + A.first_row);
  ranks.global_sum(all);
  double above = 0, below = 0;
  for (int i = 0; i < A.rows(); ++i) {
    double r = b[i];
    for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k) r -= A.value[k] * all[A.column[k]];
    above += r * r;
    below += b[i] * b[i];
  }
  return std::sqrt(ranks.global_sum(above) / ranks.global_sum(below));
}

// A right-hand side in the range: A times noise.
Vector reachable(const cases::System& s, const Communicator& ranks, int seed = 5) {
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  Vector b(s.A.rows());
  system.multiply(cases::noise_vector(s.A, seed), b);
  return b;
}

SolveReport solve(const cases::System& s, const Vector& b, Vector& x, const SolveOptions& options,
                  const Communicator& ranks) {
  return solve_spd(s.A, s.grid, s.null_space, b, x, options, ranks);
}

void check_solved(const cases::System& s, const std::string& preconditioner, int most_iterations) {
  const Communicator ranks;
  const Vector b = reachable(s, ranks);
  Vector x(s.A.rows(), 0.0);
  SolveOptions options;
  options.preconditioner = preconditioner;
  const SolveReport report = solve(s, b, x, options, ranks);
  CAPTURE(preconditioner, report.used, report.iterations, report.failed_attempts);
  CHECK(report.converged);
  CHECK(report.failed_attempts.empty());
  CHECK(report.iterations <= most_iterations);
  CHECK(residual_by_hand(s.A, b, x, ranks) <= 1.0001e-8);  // the tolerance, and round-off between two summations
}

cases::Poisson box(std::array<int, 3> size, Kind outside) {
  cases::Poisson p;
  p.size = size;
  p.dimension = size[2] == 1 ? 2 : 3;
  p.outside = outside;
  return p;
}

cases::Poisson splash(std::array<int, 3> size) {
  cases::Poisson p = box(size, Kind::wall);
  p.kind = [size](Cell c) { return cases::splash(size, c); };
  p.weight = [size](Cell c, int axis) { return cases::cut_weight(size, c, axis); };
  return p;
}

// Solution by Eigen's SparseLU on every rank: the first row of each component is grounded, then its mean is set to
// zero.
Vector reference(const cases::System& s, const Vector& b, const Communicator& ranks) {
  const auto n = Eigen::Index(s.A.global_rows);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n + 2);  // A, b, component + 1
  for (int i = 0; i < s.A.rows(); ++i) {
    const auto row = Eigen::Index(s.A.first_row + i);
    for (int k = s.A.row_start[i]; k < s.A.row_start[i + 1]; ++k) dense(row, s.A.column[k]) += s.A.value[k];
    dense(row, n) = b[i];
    dense(row, n + 1) = s.null_space.component[i] + 1;
  }
  ranks.global_sum(std::span<double>(dense.data(), std::size_t(dense.size())));
  std::vector<char> grounded(s.null_space.count, 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const int c = int(dense(i, n + 1)) - 1;
    const bool isolated = dense(i, i) == 0;
    if (isolated || (c >= 0 && !grounded[c])) {
      dense.row(i).head(n + 1).setZero();
      dense(i, i) = 1;
      if (!isolated) grounded[c] = 1;
    }
  }
  Eigen::SparseMatrix<double> sparse = dense.leftCols(n).sparseView();
  sparse.makeCompressed();
  Eigen::VectorXd x = testing::sparse_lu_solve(sparse, dense.col(n));
  for (int c = 0; c < s.null_space.count; ++c) {
    double sum = 0, count = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (int(dense(i, n + 1)) == c + 1) sum += x[i], ++count;
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      if (int(dense(i, n + 1)) == c + 1) x[i] -= sum / count;
    }
  }
  return Vector(x.data() + s.A.first_row, x.data() + s.A.first_row + s.A.rows());
}

double largest_difference(const Vector& x, const Vector& y, const Communicator& ranks) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - y[i]));
  return ranks.global_max(largest);
}

}  // namespace

TEST_CASE("every preconditioner solves the Poisson equation on open and closed boxes of even, odd and flat sizes") {
  const auto outside = GENERATE(Kind::air, Kind::wall);
  const auto size = GENERATE(Cell{16, 16, 16}, Cell{24, 20, 24}, Cell{33, 17, 40}, Cell{17, 13, 11}, Cell{48, 40, 36},
                             Cell{4, 4, 300}, Cell{61, 47, 1}, Cell{128, 96, 1});
  const cases::System s = cases::build(box(size, outside), Communicator());
  CAPTURE(size, outside == Kind::air);
  check_solved(s, "none", 1000);     // about the unknowns along the longest path; measured: 560 at most
  check_solved(s, "boomeramg", 25);  // measured: 16 at most, and a few more at other rank counts
  check_solved(s, "multigrid", 25);  // measured: 15 at most
  check_solved(s, "auto", 1000);
}

TEST_CASE("every preconditioner solves periodic boxes") {
  const auto size = GENERATE(Cell{16, 16, 16}, Cell{15, 12, 21}, Cell{40, 33, 1});
  cases::Poisson p = box(size, Kind::wall);
  p.periodic = {1, size[2] > 1 ? 1 : 0, 0};
  if (size[2] == 1) p.periodic = {1, 1, 0};
  const cases::System s = cases::build(p, Communicator());
  for (const char* name : {"none", "boomeramg", "geometric", "multigrid"}) check_solved(s, name, 300);
}

TEST_CASE("every preconditioner solves a splash with cut cells and a ghost-fluid surface") {
  const cases::System s = cases::build(splash({30, 27, 22}), Communicator());
  check_solved(s, "none", 400);
  check_solved(s, "boomeramg", 30);  // measured: 13
  check_solved(s, "multigrid", 30);  // measured: 15
}

TEST_CASE("coefficients that jump by 1e6 do not hinder multigrid") {
  cases::Poisson p = box({20, 20, 20}, Kind::wall);
  p.weight = [](Cell c, int) { return c[0] > 6 && c[0] < 14 && c[1] > 5 && c[2] < 11 ? 1e6 : 1.0; };
  const cases::System s = cases::build(p, Communicator());
  check_solved(s, "boomeramg", 40);
  check_solved(s, "multigrid", 40);
}

TEST_CASE("the solution is that of an elimination, with mean zero on each closed component") {
  const Communicator ranks;
  cases::Poisson p = box({9, 8, 7}, Kind::wall);
  p.kind = [](Cell c) {
    if (c[0] == 4) return Kind::wall;                                  // two chambers
    if (c[0] > 4 && c[1] == 7) return Kind::air;                       // the second one is open at the top
    return (c[0] + c[1] + c[2]) % 6 == 0 ? Kind::wall : Kind::liquid;  // pores, some cells cut off
  };
  const cases::System s = cases::build(p, ranks);
  REQUIRE(s.null_space.count >= 1);
  Vector b = cases::noise_vector(s.A, 3);  // not compatible: the part outside the range is removed
  SolveOptions options;
  options.tolerance = 1e-12;
  options.preconditioner = GENERATE("none", "boomeramg", "geometric", "multigrid", "auto");
  Vector x = cases::noise_vector(s.A, 4);
  const SolveReport report = solve(s, b, x, options, ranks);
  CAPTURE(options.preconditioner, report.failed_attempts);
  REQUIRE(report.converged);
  CHECK(report.mismatch > 0.01);
  LinearSystem(s.A, s.grid, s.null_space, ranks).project(b);
  // Condition number of about 1e3 times the tolerance.
  CHECK(largest_difference(x, reference(s, b, ranks), ranks) < 1e-9);
}

TEST_CASE("cells without any open face are counted, keep zero and do not disturb the rest") {
  const Communicator ranks;
  cases::Poisson p = box({12, 12, 12}, Kind::wall);
  p.kind = [](Cell c) {
    const bool lone = c == Cell{2, 2, 2} || c == Cell{9, 3, 5} || c == Cell{0, 0, 11};
    return lone || c[1] > 5 ? Kind::liquid : Kind::wall;
  };
  const cases::System s = cases::build(p, ranks);
  REQUIRE(s.null_space.count == 4);
  Vector b = cases::noise_vector(s.A, 1), x(s.A.rows(), 7.0);
  SolveOptions options;
  options.preconditioner = GENERATE("none", "boomeramg", "geometric", "multigrid");
  const SolveReport report = solve(s, b, x, options, ranks);
  CAPTURE(options.preconditioner, report.failed_attempts);
  CHECK(report.converged);
  CHECK(report.failed_attempts.empty());
  CHECK(report.identity_rows == 3);
  for (int i = 0; i < s.A.rows(); ++i) {
    if (s.A.value[s.A.row_start[i]] == 0) CHECK(x[i] == 0);
  }
}

TEST_CASE("parts joined by a link of 1e-14 are solved") {
  const Communicator ranks;
  cases::Poisson p = box({16, 12, 10}, Kind::wall);
  p.weight = [](Cell c, int axis) { return axis == 0 && c[0] == 8 ? 1e-14 : 1.0; };
  const cases::System s = cases::build(p, ranks);
  for (const char* name : {"none", "boomeramg", "geometric", "multigrid"}) check_solved(s, name, 400);
}

TEST_CASE("an incompatible right-hand side leaves its mean behind and says so") {
  const Communicator ranks;
  const cases::System s = cases::build(box({17, 13, 11}, Kind::wall), ranks);
  Vector b = reachable(s, ranks), x(s.A.rows(), 0.0);
  const Vector compatible = b;
  const double size = norm(b, ranks) / std::sqrt(double(s.A.global_rows));
  for (double& entry : b) entry += size;  // as large as the rest, so |removed| / |b| = 1 / sqrt(2)
  const SolveReport report = solve(s, b, x, {}, ranks);
  CHECK(report.converged);
  CHECK(report.mismatch == Approx(std::sqrt(0.5)).epsilon(1e-6));
  CHECK(residual_by_hand(s.A, compatible, x, ranks) <= 1.0001e-8);
}

TEST_CASE("nothing to solve is solved at once") {
  const Communicator ranks;
  cases::Poisson p = box({6, 6, 6}, Kind::wall);
  SECTION("no rows") {
    p.kind = [](Cell) { return Kind::air; };
    const cases::System s = cases::build(p, ranks);
    Vector x;
    CHECK(solve(s, {}, x, {}, ranks).converged);
  }
  SECTION("a right-hand side of zero") {
    const cases::System s = cases::build(p, ranks);
    Vector x = cases::noise_vector(s.A, 1);
    CHECK(solve(s, Vector(s.A.rows(), 0.0), x, {}, ranks).converged);
    CHECK(ranks.global_max(x.empty() ? 0 : *std::max_element(x.begin(), x.end())) == 0);
  }
  SECTION("a constant right-hand side of a closed box") {
    const cases::System s = cases::build(p, ranks);
    Vector x(s.A.rows(), 0.0);
    const SolveReport report = solve(s, Vector(s.A.rows(), 0.1), x, {}, ranks);
    CHECK(report.converged);
    CHECK(report.mismatch == Approx(1));
  }
  SECTION("a start that is the solution takes no iteration") {
    p.outside = Kind::air;
    const cases::System s = cases::build(p, ranks);
    Vector x = cases::noise_vector(s.A, 5);
    const SolveReport report = solve(s, reachable(s, ranks), x, {}, ranks);
    CHECK(report.converged);
    CHECK(report.iterations == 0);
  }
}

TEST_CASE("ranks without rows or without cells take part") {
  const Communicator ranks;
  cases::Poisson p = box({20, 18, 16}, GENERATE(Kind::air, Kind::wall));
  SECTION("all cells on the first rank") {
    p.cuts = {16};
  }
  SECTION("all cells on the last rank") {
    p.cuts = {0};
  }
  SECTION("all rows on the first rank") {
    p.cuts = {3};
    p.kind = [](Cell c) { return c[2] < 3 ? Kind::liquid : Kind::air; };
  }
  SECTION("all rows on the last rank") {
    p.cuts = {5};
    p.kind = [](Cell c) { return c[2] > 12 ? Kind::liquid : Kind::wall; };
  }
  const cases::System s = cases::build(p, ranks);
  for (const char* name : {"none", "boomeramg", "geometric", "multigrid", "auto"}) check_solved(s, name, 300);
}

TEST_CASE("two solves give the same bits") {
  const Communicator ranks;
  const cases::System s = cases::build(splash({24, 22, 20}), ranks);
  const Vector b = cases::noise_vector(s.A, 9);
  SolveOptions options;
  options.preconditioner = GENERATE("none", "boomeramg", "geometric", "multigrid");
  Vector x(s.A.rows(), 0.0), y(s.A.rows(), 0.0);
  REQUIRE(solve(s, b, x, options, ranks).converged);
  REQUIRE(solve(s, b, y, options, ranks).converged);
  CHECK(x == y);
}

TEST_CASE("a right-hand side scaled by a power of two scales the solution to the bit") {
  const Communicator ranks;
  const cases::System s = cases::build(splash({18, 20, 16}), ranks);
  Vector b = cases::noise_vector(s.A, 9);
  SolveOptions options;
  options.preconditioner = GENERATE("none", "boomeramg", "geometric", "multigrid");
  Vector x(s.A.rows(), 0.0), y(s.A.rows(), 0.0);
  REQUIRE(solve(s, b, x, options, ranks).converged);
  for (double& entry : b) entry = std::ldexp(entry, -40);
  REQUIRE(solve(s, b, y, options, ranks).converged);
  for (double& entry : y) entry = std::ldexp(entry, 40);
  CHECK(x == y);
}

// Pressures of 1e8 among coefficients that jump, as of water over gas: half a unit in the last place of them makes
// residuals of 1e-9.
TEST_CASE("a tolerance below the round-off of the solution ends at that round-off") {
  const Communicator ranks;
  cases::Poisson p = box({12, 12, 12}, Kind::air);
  p.weight = [](Cell c, int) { return c[1] < 6 ? 1.0 : 1000.0; };
  const cases::System s = cases::build(p, ranks);
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  Vector far(s.A.rows(), 1e8), b(s.A.rows()), x(s.A.rows(), 0.0);
  const Vector noise = cases::noise_vector(s.A, 3);
  for (std::size_t i = 0; i < far.size(); ++i) far[i] += noise[i];
  system.multiply(far, b);
  SolveOptions options;
  options.tolerance = 1e-18;
  options.jumps = true;
  const SolveReport report = solve(s, b, x, options, ranks);
  CAPTURE(report.residual, report.rounding, report.iterations, report.failed_attempts);
  CHECK(report.converged);
  CHECK(report.residual > options.tolerance);
  CHECK(report.residual <= report.rounding);
  CHECK(report.rounding < 1e-14);
  CHECK(residual_by_hand(s.A, b, x, ranks) < 1e-14);
  options.tolerance = 1e-8;
  Vector y(s.A.rows(), 0.0);
  CHECK(solve(s, b, y, options, ranks).rounding == 0);
}

}  // namespace solve_tests
