#include "linalg/spd/solve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "linalg/core/grid_stencil.h"
#include "linalg/krylov/krylov.h"
#include "linalg/spd/body_coupling.h"
#include "linalg/spd/deflation.h"
#include "linalg/spd/direct_solve.h"
#include "linalg/spd/hierarchy.h"

namespace seiche {
namespace {

enum class Method { conjugate_gradients, flexible_gmres, direct };

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

// Iterations per digit of the tolerance allowed to the choice of "auto" before the next attempt starts.
constexpr double iterations_per_digit = 4;

// Overwrites x as a solver that wrongly claims success.
void spoil(Vector& x, int fallback) {
  const double wrong = fallback % 2 == 0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  std::fill(x.begin(), x.end(), wrong);
}

const DistributedMatrix& checked_size(const DistributedMatrix& A) {
  constexpr Row limit = std::numeric_limits<std::int32_t>::max();
  if (A.global_rows <= limit) return A;
  throw Error(ExitCode::machine, fmt::format("the pressure system has {} unknowns, more than the {} that this build of "
                                             "hypre can number; use larger cells, or build with a 64-bit hypre",
                                             A.global_rows, limit));
}

}  // namespace

struct SpdSolver::Fallback {
  Method method;
  std::string preconditioner;
  Start start;
  int iterations;

  std::string label() const {
    if (method == Method::direct) return name(method);
    return fmt::format("{} with {}, {} start", name(method), preconditioner, start == Start::warm ? "warm" : "cold");
  }
};

// Compatible right-hand side and tolerance.
struct SpdSolver::Problem {
  Vector b;
  double norm = 0;  // of b
  double tolerance = 0;
};

struct SpdSolver::Built {
  Hierarchy hierarchy;
  std::unique_ptr<Deflation> deflation;
  int solves = 0, first_iterations = 0, last_iterations = 0;

  bool has_become_slow() const { return last_iterations > 2 * first_iterations; }
};

SpdSolver::SpdSolver(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space, BlockColumns J,
                     double c, const SolveOptions& options, const Communicator& ranks)
    : options_(options), J_(std::move(J)), liquid_(checked_size(A), grid, null_space, ranks), system_(liquid_, J_, c) {}

SpdSolver::~SpdSolver() = default;

int SpdSolver::setup_applications() const {
  int sum = 0;
  for (const auto& [name, built] : built_) sum += built->deflation ? built->deflation->applications_of_B() : 0;
  return sum;
}

std::vector<SpdSolver::Fallback> SpdSolver::make_fallback_chain(const std::string& chosen) const {
  constexpr auto cg = Method::conjugate_gradients;
  const int limit = options_.max_iterations, patience = std::max(2000, 10 * limit);  // patience: without a hierarchy
  const int start_limit = chosen == "none" ? patience : limit;
  std::vector<Fallback> chain;
  if (options_.preconditioner == "auto" && keeps_to_grid(chosen)) {
    const double digits = -std::log10(options_.tolerance);
    chain.push_back({cg, chosen, Start::warm, std::min(limit, int(iterations_per_digit * digits))});
    chain.push_back({cg, "boomeramg", Start::warm, limit});
  } else {
    chain.push_back({cg, chosen, Start::warm, start_limit});
  }
  if (chosen != "boomeramg") chain.push_back({cg, chosen, Start::cold, start_limit});
  chain.push_back({cg, "boomeramg", Start::cold, limit});
  if (chosen != "none") chain.push_back({cg, "none", Start::cold, patience});
  chain.push_back({Method::flexible_gmres, "boomeramg", Start::cold, limit});
  chain.push_back({Method::direct, "direct", Start::cold, 0});
  return chain;
}

void SpdSolver::make(const std::string& name, Built& built) const {
  built.hierarchy = make_hierarchy(name, system_, options_.jumps ? Coefficients::jumping : Coefficients::smooth);
}

SpdSolver::Built& SpdSolver::build(const std::string& name) {
  std::unique_ptr<Built>& built = built_[J_.any_deforms() && system_.is_coupled() ? name + ", coupled" : name];
  if (!built || is_outdated(*built)) make(name, *(built = std::make_unique<Built>()));
  if (!built->hierarchy.made.preconditioner) return *built;
  if (!built->deflation) built->deflation = std::make_unique<Deflation>(system_, *built->hierarchy.made.preconditioner);
  last_built_ = built->deflation.get();
  return *built;
}

// True if stiffness or contact has changed and the solver has become slow. Contact at a few nodes alone does not slow
// it down; a new hierarchy would cost far more than it saves (docs/decisions/0018-hierarchies-in-contact.md).
bool SpdSolver::is_outdated(const Built& built) const {
  return built.hierarchy.diagonal.size() > 0 && built.has_become_slow() &&
         has_changed_much(system_.bodies().diagonal(), built.hierarchy.diagonal);
}

double SpdSolver::true_residual(const Problem& problem, const Vector& x) const {
  Vector r(x.size());
  system_.residual(problem.b, x, r);
  return norm(r, system_.ranks()) / problem.norm;
}

// Residual that half a unit in the last place of each entry of b and x makes: half an epsilon of |b| + |A| |x|, over
// the norm that residuals refer to. Without the part of the bodies.
double SpdSolver::rounding_of_residual(const Problem& problem, const Vector& x) const {
  Vector magnitude(x.size());
  liquid_.multiply_magnitudes(x, magnitude);
  for (std::size_t i = 0; i < x.size(); ++i) magnitude[i] += std::abs(problem.b[i]);
  return 0.5 * std::numeric_limits<double>::epsilon() * norm(magnitude, system_.ranks()) / problem.norm;
}

// Iterates; restarts from the current x until the true residual meets the tolerance.
SpdSolver::Outcome SpdSolver::iterate(const Fallback& fallback, const Problem& problem, Vector& x) {
  Built& built = build(fallback.preconditioner);
  if (!built.hierarchy.made.preconditioner) return {0, built.hierarchy.made.failure};
  Deflation& B = *built.deflation;
  if (!B.refresh()) return {0, "the bodies' part of the preconditioner could not be factored"};
  // Slightly below the tolerance, since the residual of the recurrence drifts from the true one.
  const double target = 0.95 * problem.tolerance * problem.norm;
  Outcome total;
  for (int restart = 0; restart < 4; ++restart) {
    const KrylovLimits limits{target, fallback.iterations - total.iterations};
    B.prepare(problem.b, x);
    const KrylovResult part = fallback.method == Method::flexible_gmres
                                  ? flexible_gmres(system_, B, problem.b, x, limits, system_.ranks())
                                  : conjugate_gradients(system_, B, problem.b, x, limits, system_.ranks());
    total = {total.iterations + part.iterations, part.failure};
    const double residual = true_residual(problem, x);
    if (!part.failure.empty() || residual <= problem.tolerance || residual <= rounding_of_residual(problem, x)) break;
  }
  if (built.solves++ == 0) built.first_iterations = total.iterations;
  built.last_iterations = total.iterations;
  return total;
}

SpdSolver::Outcome SpdSolver::attempt(const Fallback& fallback, const Problem& problem, Vector& x) {
  if (fallback.start == Start::cold) std::fill(x.begin(), x.end(), 0.0);
  if (fallback.method == Method::direct) return {0, solve_directly(system_, problem.b, x)};
  return iterate(fallback, problem, x);
}

// With bodies, columns of B J model their added mass if B is a hierarchy, but not if B is a diagonal. Where deformable
// bodies yield more than the liquid, BoomerAMG needs fewer iterations (docs/decisions/0036-multigrid-with-bodies.md).
std::string SpdSolver::choose() {
  constexpr double strong = 1;
  if (without_bodies_.empty()) without_bodies_ = choose_preconditioner(options_.preconditioner, liquid_);
  if (options_.preconditioner != "auto" || J_.blocks.empty()) return without_bodies_;
  if (with_bodies_.empty()) {
    with_bodies_ = without_bodies_;
    if (with_bodies_ == "none") with_bodies_ = box_of_rows(liquid_).cells() > 0 ? "geometric" : "boomeramg";
  }
  const std::string& chosen = with_bodies_;
  if (!J_.any_deforms() || !system_.is_coupled()) return chosen;
  const auto yields = [&] {
    return coupling_strength(liquid_, J_, system_.bodies().diagonal(), system_.scale()) > strong;
  };
  if (choice_.empty()) choice_ = keeps_to_grid(chosen) && yields() ? "boomeramg" : chosen;
  return choice_;
}

Eigen::MatrixXd SpdSolver::added_mass_estimate() const {
  if (!last_built_) return Eigen::MatrixXd::Zero(J_.columns(), J_.columns());
  return system_.scale() * last_built_->estimate_schur();
}

// x holds the best finite vector so far.
void SpdSolver::try_fallback_chain(const Problem& problem, Vector& x, SolveReport& report) {
  const std::string chosen = choose();
  Vector y = x;
  int index = 0;
  for (const Fallback& fallback : make_fallback_chain(chosen)) {
    const Outcome result = attempt(fallback, problem, y);
    if (index < options_.fail_first) spoil(y, index);
    ++index;
    system_.project(y);
    const double residual = true_residual(problem, y);
    report.iterations += result.iterations;
    report.used = fallback.method == Method::direct ? "direct" : fallback.preconditioner;
    const double rounding = residual <= problem.tolerance ? 0 : rounding_of_residual(problem, y);
    report.converged = residual <= std::max(problem.tolerance, rounding) && all_finite(y, system_.ranks());
    report.rounding = report.converged ? rounding : 0;
    if (report.converged || residual < report.residual) {
      x = y;
      report.residual = residual;
    }
    if (report.converged) return;
    report.failed_attempts.push_back(fmt::format("{}: residual {:.2e} after {} iterations{}{}", fallback.label(),
                                                 residual, result.iterations, result.failure.empty() ? "" : ", ",
                                                 result.failure));
  }
}

// Removes from b the part outside the range. Returns |removed part| / |b|.
double SpdSolver::make_compatible(Vector& b) const {
  const double before = norm(b, system_.ranks());
  Vector removed = b;
  system_.project(b);
  system_.project(b);  // again, for the round-off of the first means
  for (std::size_t i = 0; i < b.size(); ++i) removed[i] -= b[i];
  return before > 0 ? norm(removed, system_.ranks()) / before : 0;
}

SolveReport SpdSolver::solve(const BodyMatrix& H, const Vector& b, Vector& x, double scale) {
  const Communicator& ranks = system_.ranks();
  SolveReport report;
  report.used = "none";
  report.identity_rows = liquid_.identity_rows();
  report.converged = liquid_.pattern().global_rows == 0;
  if (report.converged) return report;
  system_.set_bodies(H);
  if (!all_finite(liquid_.values(), ranks) || !all_finite(b, ranks)) {
    report.residual = std::numeric_limits<double>::infinity();
    report.failed_attempts.push_back("the matrix or the right-hand side is not finite");
    return report;
  }
  Problem problem{b, norm(b, ranks), options_.tolerance};
  report.mismatch = make_compatible(problem.b);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * problem.norm;
  problem.norm = scale > 0 ? scale : norm(problem.b, ranks);
  if (problem.norm <= rounding || !all_finite(x, ranks)) std::fill(x.begin(), x.end(), 0.0);
  system_.project(x);
  report.converged = problem.norm <= rounding;
  if (report.converged) return report;
  report.residual = true_residual(problem, x);
  report.converged = report.residual <= problem.tolerance && options_.fail_first == 0;
  if (!report.converged) try_fallback_chain(problem, x, report);
  return report;
}

SolveReport solve_spd(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space, const Vector& b,
                      Vector& x, const SolveOptions& options, const Communicator& ranks) {
  return SpdSolver(A, grid, null_space, {}, 0, options, ranks).solve(BodyMatrix(ranks), b, x);
}

}  // namespace seiche
