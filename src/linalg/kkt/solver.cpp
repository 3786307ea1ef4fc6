#include "linalg/kkt/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "linalg/core/shared_columns.h"
#include "linalg/kkt/preconditioner.h"
#include "linalg/krylov/minres.h"

namespace seiche {
namespace {

AmgSettings kkt_amg_settings(const std::string& strength) {
  AmgSettings settings;
  settings.aggressive_levels = 0;
  settings.sweeps = strength == "strong" ? 3 : 2;
  return settings;
}

}  // namespace

struct KktSolver::Problem {
  Vector b;
  double scale;               // of the continuity residual
  Eigen::VectorXd g, weight;  // right-hand side of momentum; diag(H)^-1/2
};

KktSolver::KktSolver(const KktSystem& s, const SaddleOptions& options, const Communicator& ranks)
    : system_(s),
      options_(options),
      ranks_(ranks),
      A_(s.A, s.grid, s.closed, ranks),
      coupled_(A_, s.J, s.c1 * s.c2),
      bodies_(ranks) {}

KktSolver::~KktSolver() = default;

KktSolver::Residual KktSolver::measure(const Problem& problem, const Vector& x) const {
  Vector r(x.size()), flux, p;
  Eigen::VectorXd momentum, v;
  K_->residual(problem.b, x, r);
  K_->unpack(r, flux, momentum);
  coupled_.project(flux);
  K_->unpack(x, p, v);
  momentum *= system_.c2 / system_.c1;
  const Eigen::VectorXd push = system_.c2 * multiply_transposed(system_.J, p, ranks_);
  const auto weighed = [&](const Eigen::VectorXd& f) { return f.cwiseProduct(problem.weight).norm(); };
  // Round-off of H v does not count against the tolerance: its terms cancel for stiff bodies.
  constexpr double rounding = 32 * std::numeric_limits<double>::epsilon();
  const double floor = rounding * v.cwiseQuotient(problem.weight).norm() / options_.tolerance;
  const double scale = std::max(weighed(problem.g) + weighed(push), floor);
  return {weighed(momentum) / (scale > 0 ? scale : 1), norm(flux, ranks_) / problem.scale};
}

std::string KktSolver::attempt(const std::string& strength, const Problem& problem, Vector& x, SaddleReport& report) {
  if (strength == "strong") motions_.clear();
  KktPreconditioner B(*K_, bodies_, kkt_amg_settings(strength), motions_);
  if (!B.failure().empty()) {
    motions_.clear();
    indefinite_ = B.met_indefinite();
    return B.failure();
  }
  double target = -1;
  const auto finished = [&](double estimate, const Vector& now) {
    if (K_->met_indefinite()) return true;
    if (target >= 0 && estimate > target) return false;
    const Residual residual = measure(problem, now);
    report.set(residual.momentum, residual.continuity);
    const double excess = report.residual / options_.tolerance;
    if (excess <= 1) return true;
    target = target < 0 ? 2 * estimate / excess : estimate * std::clamp(0.8 / excess, 0.1, 0.7);
    return false;
  };
  const KrylovResult result = minimal_residuals(*K_, B, problem.b, x, options_.max_iterations, ranks_, finished);
  report.iterations += result.iterations;
  return result.failure;
}

// Makes b compatible and reports the relative norm of the removed part.
KktSolver::Problem KktSolver::pose(const Vector& b, const Eigen::VectorXd& g, double scale,
                                   SaddleReport& report) const {
  Vector reachable = b, removed = b;
  coupled_.project(reachable);
  coupled_.project(reachable);  // again, for the round-off of the first means
  add_scaled(removed, -1, reachable);
  const double size = norm(b, ranks_);
  report.mismatch = size > 0 ? norm(removed, ranks_) / size : 0;
  if (scale <= 0) scale = size > 0 ? size : 1;
  return {K_->pack(reachable, -system_.c1 / system_.c2 * g), scale, g, bodies_.diagonal().cwiseSqrt().cwiseInverse()};
}

KktReport KktSolver::solve(const SparseMatrix& H, const Vector& b, const Eigen::VectorXd& g, Vector& p,
                           Eigen::VectorXd& v, double scale) {
  KktReport all;
  SaddleReport& report = all.solve;
  report.set(INFINITY, INFINITY);
  if ((shared_diagonal(H, ranks_).array() <= 0).any()) {
    all.indefinite = true;
    return all;
  }
  if (!all_finite(b, ranks_) || !all_finite(A_.values(), ranks_) || ranks_.any(!g.allFinite())) {
    report.failed_attempts.push_back("the matrix or the right-hand side is not finite");
    return all;
  }
  indefinite_ = false;
  bodies_.keep(H);
  coupled_.set_bodies(bodies_);
  K_ = std::make_unique<KktOperator>(system_, A_, bodies_.matrix());
  const Problem problem = pose(b, g, scale, report);
  coupled_.project(p);
  Vector x = K_->pack(p, v);
  for (const char* strength : {"standard", "strong"}) {
    if (!all_finite(x, ranks_) || strength == std::string("strong")) std::fill(x.begin(), x.end(), 0.0);
    const std::string failure = attempt(strength, problem, x, report);
    all.indefinite = indefinite_ || K_->met_indefinite();
    if (all.indefinite) break;
    const Residual residual = measure(problem, x);
    report.set(residual.momentum, residual.continuity);
    report.used = fmt::format("MINRES with {} multigrid", strength);
    report.converged = report.residual <= options_.tolerance;
    if (report.converged) break;
    report.failed_attempts.push_back(fmt::format("{}: momentum {:.2e}, continuity {:.2e} after {} iterations{}{}",
                                                 report.used, residual.momentum, residual.continuity, report.iterations,
                                                 failure.empty() ? "" : ", ", failure));
  }
  if (all.indefinite) motions_.clear();
  K_->unpack(x, p, v);
  coupled_.project(p);
  return all;
}

}  // namespace seiche
