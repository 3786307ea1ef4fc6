#include <catch2/catch.hpp>

#include <limits>

#include "base/error.h"
#include "linalg/krylov/krylov.h"
#include "linalg/precond/preconditioners.h"
#include "linalg/spd/direct_solve.h"
#include "linalg/spd/solve.h"
#include "unit/linalg/cases.h"

namespace fallback_chain_tests {
using namespace seiche;
using cases::Cell;
using cases::Kind;

// hypre's function, so that a test can leave its error flag raised.
extern "C" void hypre_error_handler(const char* file, int line, int error, const char* message);

namespace {

cases::System splash_system(const Communicator& ranks) {
  cases::Poisson p;
  p.size = {18, 17, 15};
  p.kind = [size = p.size](Cell c) { return cases::splash(size, c); };
  return cases::build(p, ranks);
}

double distance(const Vector& x, const Vector& y, const Communicator& ranks) {
  Vector difference = x;
  add_scaled(difference, -1, y);
  return norm(difference, ranks) / norm(y, ranks);
}

}  // namespace

TEST_CASE("solvers that claim success wrongly are caught, and the ladder gives the reference result") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  const Vector b = cases::noise_vector(s.A, 1);
  SolveOptions options;
  options.tolerance = 1e-11;
  Vector reference(s.A.rows(), 0.0);
  REQUIRE(solve_spd(s.A, s.grid, s.null_space, b, reference, options, ranks).converged);
  options.preconditioner = GENERATE("auto", "none", "boomeramg", "geometric", "multigrid");
  options.fail_first = GENERATE(1, 2, 3, 4);
  Vector x(s.A.rows(), 0.0);
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, x, options, ranks);
  CAPTURE(options.preconditioner, report.failed_attempts);
  CHECK(report.converged);
  CHECK(int(report.failed_attempts.size()) == options.fail_first);
  CHECK(report.residual <= options.tolerance);
  CHECK(distance(x, reference, ranks) < 1e-8);  // condition number of about 1e3 times the tolerance
}

TEST_CASE("the last rung eliminates") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  const Vector b = cases::noise_vector(s.A, 1);
  SolveOptions options;
  options.preconditioner = "boomeramg";
  options.fail_first = 4;
  Vector x(s.A.rows(), 0.0);
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, x, options, ranks);
  CHECK(report.converged);
  CHECK(report.used == "direct");
  CHECK(report.residual < 1e-12);  // round-off of an elimination with one refinement
}

TEST_CASE("when every rung fails the report says so and x stays finite") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  const Vector b = cases::noise_vector(s.A, 1);
  SolveOptions options;
  options.fail_first = 100;
  Vector x(s.A.rows(), 0.0);
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, x, options, ranks);
  CHECK_FALSE(report.converged);
  CHECK(report.failed_attempts.size() >= 5);
  CHECK(report.residual > options.tolerance);
  CHECK(all_finite(x, ranks));
}

TEST_CASE("no iterations allowed: the ladder still ends with the solution") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  const Vector b = cases::noise_vector(s.A, 1);
  SolveOptions options;
  options.preconditioner = GENERATE("boomeramg", "geometric", "multigrid");
  options.max_iterations = 0;
  Vector x(s.A.rows(), 0.0);
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, x, options, ranks);
  CHECK(report.converged);
  CHECK(report.used == "none");
}

TEST_CASE("an error flag left raised in hypre has no effect") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  const Vector b = cases::noise_vector(s.A, 1);
  SolveOptions options;
  options.preconditioner = GENERATE("boomeramg", "geometric", "multigrid");
  Vector x(s.A.rows(), 0.0), y(s.A.rows(), 0.0);
  REQUIRE(solve_spd(s.A, s.grid, s.null_space, b, x, options, ranks).converged);
  hypre_error_handler("test", 1, 1, nullptr);
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, y, options, ranks);
  CHECK(report.converged);
  CHECK(report.failed_attempts.empty());
  CHECK(x == y);
}

TEST_CASE("narrow winding channels, where the grid's multigrid stalls, are solved by the next attempt") {
  const Communicator ranks;
  cases::Poisson p;
  p.size = {31, 31, 9};
  p.kind = [](Cell c) {  // one channel a cell wide, back and forth along y, in every other layer
    const bool turn = c[0] == ((c[1] / 2) % 2 == 0 ? 30 : 0);
    return c[2] % 2 == 0 && (c[1] % 2 == 0 || turn) ? Kind::liquid : Kind::wall;
  };
  const cases::System s = cases::build(p, ranks);
  REQUIRE(s.A.global_rows > 2000);
  const Vector b = cases::noise_vector(s.A, 1);
  Vector x(s.A.rows(), 0.0);
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, x, {}, ranks);
  CAPTURE(report.failed_attempts);
  CHECK(report.converged);
  CHECK(report.residual <= 1e-8);
}

TEST_CASE("flexible GMRES solves with a preconditioner that is not symmetric") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  const LinearSystem system(s.A, s.grid, s.null_space, ranks);
  const auto made = make_preconditioner("boomeramg", system);
  struct Skewed {
    Preconditioner& inner;
    void apply(const Vector& r, Vector& z) {
      inner.apply(r, z);
      for (std::size_t i = 0; i < z.size(); ++i) z[i] *= 1 + 0.3 * double(i % 3);
    }
  } skewed{*made.preconditioner};
  const Vector b = cases::noise_vector(s.A, 1);
  Vector x(s.A.rows(), 0.0), r(s.A.rows());
  const double target = 1e-9 * norm(b, ranks);
  const KrylovResult result = flexible_gmres(system, skewed, b, x, {target, 200}, ranks, 15);
  CAPTURE(result.iterations, result.failure);
  CHECK(result.failure.empty());
  system.residual(b, x, r);
  CHECK(norm(r, ranks) <= 1.0001 * target);
}

TEST_CASE("numbers that are not finite are refused before any solver sees them") {
  const Communicator ranks;
  cases::System s = splash_system(ranks);
  Vector b = cases::noise_vector(s.A, 1), x(s.A.rows(), 0.0);
  const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  SECTION("in the right-hand side") {
    if (!b.empty() && s.A.first_row == 0) b[0] = bad;
  }
  SECTION("in the matrix") {
    if (s.A.rows() > 0 && s.A.first_row == 0) s.A.value[1] = bad;
  }
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, b, x, {}, ranks);
  CHECK_FALSE(report.converged);
  CHECK(all_finite(x, ranks));
}

TEST_CASE("a start that is not finite is replaced by a cold one") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  Vector x(s.A.rows(), std::numeric_limits<double>::quiet_NaN());
  const SolveReport report = solve_spd(s.A, s.grid, s.null_space, cases::noise_vector(s.A, 1), x, {}, ranks);
  CHECK(report.converged);
  CHECK(report.failed_attempts.empty());
}

TEST_CASE("more rows than hypre counts are refused in words") {
  const Communicator ranks;
  DistributedMatrix A;
  A.global_rows = Row(1) << 31;
  Vector x;
  try {
    (void)solve_spd(A, {}, {}, {}, x, {}, ranks);
    FAIL("accepted");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::machine);
    CHECK_THAT(error.what(), Catch::Contains("2147483648"));
  }
}

TEST_CASE("an unknown preconditioner is refused with the names there are") {
  const Communicator ranks;
  const cases::System s = splash_system(ranks);
  Vector x(s.A.rows(), 0.0);
  SolveOptions options;
  options.preconditioner = "magic";
  CHECK_THROWS_WITH(solve_spd(s.A, s.grid, s.null_space, cases::noise_vector(s.A, 1), x, options, ranks),
                    Catch::Contains("boomeramg") && Catch::Contains("multigrid"));
}

}  // namespace fallback_chain_tests
