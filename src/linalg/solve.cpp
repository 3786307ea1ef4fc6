#include "linalg/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "linalg/direct_solve.h"
#include "linalg/krylov.h"
#include "linalg/linear_system.h"
#include "linalg/preconditioners.h"

namespace seiche {
namespace {

enum class Method { conjugate_gradients, flexible_gmres, direct };
enum class Start { warm, cold };

struct Rung {
  Method method;
  std::string preconditioner;
  Start start;
  int iterations;
};

const char* name(Method method) {
  switch (method) {
    case Method::conjugate_gradients:
      return "conjugate gradients";
    case Method::flexible_gmres:
      return "flexible GMRES";
    case Method::direct:
      return "direct";
  }
  return "";
}

std::string label(const Rung& rung) {
  if (rung.method == Method::direct) return name(rung.method);
  return fmt::format("{} with {}, {} start", name(rung.method), rung.preconditioner,
                     rung.start == Start::warm ? "warm" : "cold");
}

// What "auto" chose must earn its keep: so many iterations for each digit of the tolerance, or the next rung's turn.
constexpr double iterations_per_digit = 4;

std::vector<Rung> make_ladder(const std::string& asked, const std::string& chosen, const SolveOptions& options) {
  constexpr auto cg = Method::conjugate_gradients;
  const int limit = options.max_iterations, patience = std::max(2000, 10 * limit);  // the latter without a hierarchy
  const int start_limit = chosen == "none" ? patience : limit;
  std::vector<Rung> ladder;
  if (asked == "auto" && chosen == "multigrid") {
    const double digits = -std::log10(options.tolerance);
    ladder.push_back({cg, chosen, Start::warm, std::min(limit, int(iterations_per_digit * digits))});
    ladder.push_back({cg, "boomeramg", Start::warm, limit});
  } else {
    ladder.push_back({cg, chosen, Start::warm, start_limit});
  }
  if (chosen != "boomeramg") ladder.push_back({cg, chosen, Start::cold, start_limit});
  ladder.push_back({cg, "boomeramg", Start::cold, limit});
  if (chosen != "none") ladder.push_back({cg, "none", Start::cold, patience});
  ladder.push_back({Method::flexible_gmres, "boomeramg", Start::cold, limit});
  ladder.push_back({Method::direct, "direct", Start::cold, 0});
  return ladder;
}

// Keeps each preconditioned residual off the null space.
struct ProjectedPreconditioner {
  Preconditioner& preconditioner;
  const LinearSystem& system;
  void apply(const Vector& r, Vector& z) {
    preconditioner.apply(r, z);
    system.project(z);
  }
};

// A compatible right-hand side and what a solution must reach.
struct Problem {
  Vector b;
  double norm = 0;  // of b
  double tolerance = 0;
};

double true_residual(const LinearSystem& system, const Problem& problem, const Vector& x) {
  Vector r(x.size());
  system.residual(problem.b, x, r);
  return norm(r, system.ranks()) / problem.norm;
}

KrylovResult iterate(const LinearSystem& system, const Rung& rung, ProjectedPreconditioner& B, const Problem& problem,
                     Vector& x, int iterations) {
  // A little less than the tolerance: the residual that the loops update drifts from the true one.
  const KrylovLimits limits{0.95 * problem.tolerance * problem.norm, iterations};
  if (rung.method == Method::flexible_gmres) {
    return flexible_gmres(system, B, problem.b, x, limits, system.ranks());
  }
  return conjugate_gradients(system, B, problem.b, x, limits, system.ranks());
}

// Iterates, and starts again from where it stands while the true residual is not there yet.
KrylovResult climb_iterative(const LinearSystem& system, const Rung& rung, const Problem& problem, Vector& x) {
  const PreconditionerOrFailure made = make_preconditioner(rung.preconditioner, system);
  if (!made.preconditioner) return {0, made.failure};
  ProjectedPreconditioner B{*made.preconditioner, system};
  KrylovResult total;
  for (int restart = 0; restart < 4; ++restart) {
    const KrylovResult part = iterate(system, rung, B, problem, x, rung.iterations - total.iterations);
    total = {total.iterations + part.iterations, part.failure};
    if (!part.failure.empty() || true_residual(system, problem, x) <= problem.tolerance) break;
  }
  return total;
}

KrylovResult climb(const LinearSystem& system, const Rung& rung, const Problem& problem, Vector& x) {
  if (rung.start == Start::cold) std::fill(x.begin(), x.end(), 0.0);
  if (rung.method == Method::direct) return {0, solve_directly(system, problem.b, x)};
  return climb_iterative(system, rung, problem, x);
}

// What a solver that claims success wrongly leaves behind.
void spoil(Vector& x, int rung) {
  const double wrong = rung % 2 == 0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  std::fill(x.begin(), x.end(), wrong);
}

std::string failure_line(const Rung& rung, const KrylovResult& result, double residual) {
  return fmt::format("{}: residual {:.2e} after {} iterations{}{}", label(rung), residual, result.iterations,
                     result.failure.empty() ? "" : ", ", result.failure);
}

// x keeps the best finite vector met.
void climb_ladder(const LinearSystem& system, const Problem& problem, const SolveOptions& options, Vector& x,
                  SolveReport& report) {
  const std::string chosen = choose_preconditioner(options.preconditioner, system);
  Vector y = x;
  int index = 0;
  for (const Rung& rung : make_ladder(options.preconditioner, chosen, options)) {
    const KrylovResult result = climb(system, rung, problem, y);
    if (index < options.fail_rungs) spoil(y, index);
    ++index;
    system.project(y);
    const double residual = true_residual(system, problem, y);
    report.iterations += result.iterations;
    report.used = rung.method == Method::direct ? "direct" : rung.preconditioner;
    report.converged = residual <= problem.tolerance && all_finite(y, system.ranks());
    if (report.converged || residual < report.residual) {
      x = y;
      report.residual = residual;
    }
    if (report.converged) return;
    report.ladder.push_back(failure_line(rung, result, residual));
  }
}

// Takes out of b what no x can reach, in place; |part taken out| / |b|.
double make_compatible(const LinearSystem& system, Vector& b) {
  const double before = norm(b, system.ranks());
  Vector removed = b;
  system.project(b);
  system.project(b);  // once more for the rounding of the first means
  for (std::size_t i = 0; i < b.size(); ++i) removed[i] -= b[i];
  return before > 0 ? norm(removed, system.ranks()) / before : 0;
}

void check_size(const SparseMatrix& A) {
  constexpr Row limit = std::numeric_limits<std::int32_t>::max();
  if (A.global_rows <= limit) return;
  throw Error(ExitCode::machine, fmt::format("the pressure system has {} rows, but hypre as built here counts to {}; "
                                             "use larger cells, or a hypre with 64-bit integers",
                                             A.global_rows, limit));
}

}  // namespace

SolveReport solve_spd(const SparseMatrix& A, const RowGrid& grid, const NullSpace& null_space, const Vector& b,
                      Vector& x, const SolveOptions& options, const Communicator& ranks) {
  check_size(A);
  SolveReport report;
  report.used = "none";
  report.converged = A.global_rows == 0;
  if (report.converged) return report;
  if (!all_finite(A.value, ranks) || !all_finite(b, ranks)) {
    report.residual = std::numeric_limits<double>::infinity();
    report.ladder.push_back("the matrix or the right-hand side is not finite");
    return report;
  }
  const LinearSystem system(A, grid, null_space, ranks);
  report.identity_rows = system.identity_rows();
  Problem problem{b, norm(b, ranks), options.tolerance};
  report.mismatch = make_compatible(system, problem.b);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * problem.norm;
  problem.norm = norm(problem.b, ranks);
  if (problem.norm <= rounding || !all_finite(x, ranks)) std::fill(x.begin(), x.end(), 0.0);
  system.project(x);
  report.converged = problem.norm <= rounding;
  if (report.converged) return report;
  report.residual = true_residual(system, problem, x);
  report.converged = report.residual <= problem.tolerance && options.fail_rungs == 0;
  if (!report.converged) climb_ladder(system, problem, options, x, report);
  return report;
}

}  // namespace seiche
