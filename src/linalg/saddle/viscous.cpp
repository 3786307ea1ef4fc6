// The velocity block of a saddle-point system on its own.
#include <fmt/format.h>

#include "linalg/krylov/krylov.h"
#include "linalg/saddle/preconditioner.h"
#include "linalg/saddle/solver.h"

namespace seiche {
namespace {

void weigh(const Vector& w, Vector& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] *= w[i];
}

// W K W with K = [F G; G' H], W = diag(F, H)^-1/2. Its residuals, for the right-hand side W b, are in the norm of the
// tolerance.
class ScaledViscous {
 public:
  ScaledViscous(const SaddleOperator& K, const Vector& w) : K_(K), w_(w) {}
  void multiply(const Vector& x, Vector& y) const {
    Vector wx = x;
    weigh(w_, wx);
    const Vector u(wx.begin(), wx.begin() + K_.velocities());
    Eigen::VectorXd v = Eigen::VectorXd::Zero(K_.unknowns()), fv;
    std::copy(wx.begin() + K_.velocities(), wx.end(), v.begin());
    make_identical(v, K_.ranks());
    Vector fu;
    K_.multiply_velocity(u, v, fu, fv);
    K_.drop_multipliers(fv);
    y = K_.pack(fu, fv, {});
    weigh(w_, y);
  }
  void residual(const Vector& b, const Vector& x, Vector& r) const {
    multiply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
  }

 private:
  const SaddleOperator& K_;
  const Vector& w_;
};

struct ScaledPreconditioner {
  SaddlePreconditioner& B;
  const Vector& w;
  void apply(const Vector& r, Vector& z) {
    Vector own(r.size());
    for (std::size_t i = 0; i < r.size(); ++i) own[i] = r[i] / w[i];
    B.apply_viscous(own, z);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] /= w[i];
  }
};

}  // namespace

// Restarts until the true residual meets the tolerance, since the residual of the recurrence drifts from it.
SaddleSolver::Outcome SaddleSolver::iterate_viscous(SaddlePreconditioner& B, const Vector& w, const Vector& b,
                                                    Vector& x, SaddleReport& report) {
  const ScaledViscous A(K_, w);
  ScaledPreconditioner P{B, w};
  const double scale = norm(b, K_.ranks());
  Vector r(b.size());
  Outcome attempt{0, B.refresh_velocity()};
  for (int restart = 0; restart < 4 && attempt.failure.empty(); ++restart) {
    const KrylovLimits limits{0.95 * options_.tolerance * scale, options_.max_iterations - attempt.iterations};
    const KrylovResult part = conjugate_gradients(A, P, b, x, limits, K_.ranks());
    attempt = {attempt.iterations + part.iterations, part.failure};
    A.residual(b, x, r);
    report.set(scale > 0 ? norm(r, K_.ranks()) / scale : 0, 0);
    report.converged = report.residual <= options_.tolerance;
    if (report.converged) break;
  }
  report.iterations += attempt.iterations;
  return attempt;
}

SaddleReport SaddleSolver::solve_viscous(const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g, Vector& u,
                                         Eigen::VectorXd& v) {
  SaddleReport report;
  set_bodies(H);
  if (const std::string bad = find_bad(f, g, {}); !bad.empty()) {
    report.set(INFINITY, 0);
    report.failed_attempts.push_back(bad);
    return report;
  }
  const Vector w = momentum_weight();
  Vector b = K_.pack(f, g, {}), x = K_.pack(u, v, {});
  weigh(w, b);
  const bool cold = norm(b, K_.ranks()) == 0 || !all_finite(x, K_.ranks());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = cold ? 0 : x[i] / w[i];
  for (const char* strength : {"standard", "strong"}) {
    report.used = fmt::format("conjugate gradients with {} boomeramg", strength);
    const Outcome result = iterate_viscous(build(options_.preconditioner, strength), w, b, x, report);
    if (report.converged) break;
    report.failed_attempts.push_back(fmt::format("{}: residual {:.2e} after {} iterations{}{}", report.used,
                                                 report.residual, result.iterations, result.failure.empty() ? "" : ", ",
                                                 result.failure));
    if (strength == std::string("standard")) std::fill(x.begin(), x.end(), 0.0);
  }
  weigh(w, x);
  u.assign(x.begin(), x.begin() + K_.velocities());
  v.setZero(K_.unknowns());
  std::copy(x.begin() + K_.velocities(), x.end(), v.begin());
  make_identical(v, K_.ranks());
  return report;
}

}  // namespace seiche
