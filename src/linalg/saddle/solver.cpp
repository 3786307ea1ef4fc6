#include "linalg/saddle/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "linalg/krylov/minres.h"
#include "linalg/saddle/preconditioner.h"

namespace seiche {
namespace {

enum class Krylov { gmres, minres };

// hypre counts rows in 32 bits.
const SaddleSystem& checked_size(const SaddleSystem& s) {
  constexpr Row limit = std::numeric_limits<std::int32_t>::max();
  if (s.F.global_rows <= limit) return s;
  throw Error(ExitCode::machine, fmt::format("the viscous system has {} unknowns, more than the {} that this build of "
                                             "hypre can number; use larger cells, or build with a 64-bit hypre",
                                             s.F.global_rows, limit));
}

// BoomerAMG on faces and cells: "standard", or "strong", which costs more and fails less. Aggressive coarsening would
// nearly double the iterations.
AmgSettings saddle_amg_settings(const std::string& strength) {
  AmgSettings settings;
  settings.aggressive_levels = 0;
  if (strength == "strong") settings.sweeps = 2;
  return settings;
}

Vector multiplied(const Vector& a, Vector b) {
  for (std::size_t i = 0; i < b.size(); ++i) b[i] *= a[i];
  return b;
}

}  // namespace

struct SaddleSolver::Fallback {
  Krylov method;
  std::string pressure, strength;
  Start start;

  std::string label() const {
    return fmt::format("{} with {} {}, {} start", method == Krylov::minres ? "MINRES" : "GMRES", strength, pressure,
                       start == Start::warm ? "warm" : "cold");
  }
};

// Compatible right-hand side and the weight of each row's residual.
struct SaddleSolver::Problem {
  Vector b;
  Vector weight;  // momentum: (diag(F, H) scale^2)^-1/2; continuity: 1 / scale
};

struct SaddleSolver::Residual {
  double momentum = 0, continuity = 0;
  double larger() const { return std::isnan(momentum + continuity) ? NAN : std::max(momentum, continuity); }
};

void SaddleReport::set(double of_momentum, double of_continuity) {
  momentum = of_momentum;
  continuity = of_continuity;
  residual = std::max(momentum, continuity);
}

SaddleSolver::SaddleSolver(const SaddleSystem& system, const SaddleOptions& options, const Communicator& ranks)
    : system_(checked_size(system)),
      options_(options),
      K_(system_, ranks),
      coupled_(K_.liquid(), system_.J, 1 / system_.schur_scale) {}

SaddleSolver::~SaddleSolver() = default;

SaddlePreconditioner& SaddleSolver::build(const std::string& pressure, const std::string& strength) {
  const std::string key = pressure + ", " + strength;
  for (auto& [name, made] : built_)
    if (name == key) return *made;
  built_.emplace_back(key, std::make_unique<SaddlePreconditioner>(K_, pressure, saddle_amg_settings(strength)));
  return *built_.back().second;
}

SaddleSolver::Residual SaddleSolver::measure(const Problem& problem, const Vector& x) const {
  Vector r(x.size());
  K_.residual(problem.b, x, r);
  const auto faces = r.begin() + K_.velocities(), cells = faces + K_.pressures();
  Vector flux(faces, cells);
  coupled_.project(flux);
  std::copy(flux.begin(), flux.end(), faces);
  std::array<double, 2> sums{0, 0};
  for (std::size_t i = 0; i < r.size(); ++i) {
    const bool continuity = int(i) >= K_.velocities() && int(i) < K_.velocities() + K_.pressures();
    sums[continuity] += std::pow(problem.weight[i] * r[i], 2);
  }
  K_.ranks().global_sum(sums);
  return {std::sqrt(sums[0]), std::sqrt(sums[1])};
}

// diag(F, H)^-1/2
Vector SaddleSolver::momentum_weight() const {
  Vector w(std::size_t(K_.velocities()));
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = 1 / std::sqrt(K_.faces().diagonal(int(i)));
  Eigen::VectorXd body(K_.unknowns());
  if (body.size() > 0) body = K_.bodies().matrix().diagonal().cwiseSqrt().cwiseInverse();
  return K_.pack(w, body, {});
}

// Round-off of the sums in D u: a hundred epsilon of the Frobenius norm of D diag(u).
double SaddleSolver::rounding_of_divergence(const Vector& u) const {
  const DistributedMatrix& Dt = system_.Dt;
  double sum = 0;
  for (int i = 0; i < Dt.rows(); ++i)
    for (int k = Dt.row_start[i]; k < Dt.row_start[i + 1]; ++k) sum += std::pow(Dt.value[k] * u[i], 2);
  return 100 * std::numeric_limits<double>::epsilon() * std::sqrt(K_.ranks().global_sum(sum));
}

// Sets the scales from the flow (u, v) without the constraint and the pressure that enforces it. Without a
// preconditioner only f, g and q are used. If u has no divergence but round-off (shear between plates), the tolerance
// allows for that much.
SaddleSolver::Problem SaddleSolver::pose(const Vector& f, const Eigen::VectorXd& g, const Vector& q,
                                         double flux_scale) {
  Problem problem{K_.pack(f, g, q), {}};
  Vector u, p, fu(f.size(), 0.0), flux;
  Eigen::VectorXd v, fv = Eigen::VectorXd::Zero(g.size());
  Vector weight = momentum_weight();
  const auto momentum = [&](const Vector& a, const Eigen::VectorXd& b) {
    return norm(multiplied(weight, K_.pack(a, b, {})), K_.ranks());
  };
  double momentum_scale = momentum(f, g), across = norm(q, K_.ranks());
  SaddlePreconditioner& B = build(options_.preconditioner, "standard");
  if (B.refresh().empty()) {
    Vector z;
    B.apply_triangular(problem.b, z);
    K_.unpack(z, u, v, p);
    K_.add_gradient(p, fu, fv);
    K_.divergence(u, v, flux);
    coupled_.project(flux);
    const double more = momentum(fu, fv), free = norm(flux, K_.ranks());
    if (std::isfinite(more + free))
      momentum_scale += more, across = std::max(across + free, rounding_of_divergence(u) / options_.tolerance);
  }
  if (flux_scale > 0) across = flux_scale;
  // Without any driving term the residuals are absolute.
  for (double& entry : weight) entry /= momentum_scale > 0 ? momentum_scale : 1;
  problem.weight = weight;
  problem.weight.insert(problem.weight.begin() + K_.velocities(), q.size(), 1 / (across > 0 ? across : 1));
  return problem;
}

namespace {

// Scales residuals for gmres() to the norm of the tolerance.
struct WeightedOperator {
  const SaddleOperator& K;
  const CoupledSystem& null_space;
  const Vector& weight;
  void weigh(Vector& r) const {
    const auto faces = r.begin() + K.velocities();
    Vector flux(faces, faces + K.pressures());
    null_space.project(flux);
    std::copy(flux.begin(), flux.end(), faces);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] *= weight[i];
  }
  void multiply(const Vector& x, Vector& y) const { K.multiply(x, y), weigh(y); }
  void residual(const Vector& b, const Vector& x, Vector& r) const { K.residual(b, x, r), weigh(r); }
};

struct WeightedPreconditioner {
  SaddlePreconditioner& B;
  const Vector& weight;
  void apply(const Vector& r, Vector& z) {
    Vector own(r.size());
    for (std::size_t i = 0; i < r.size(); ++i) own[i] = r[i] / weight[i];
    B.apply_triangular(own, z);
  }
};

}  // namespace

// MINRES watches the norm of its preconditioner. Whenever that has fallen to `target`, the residual in the norm of the
// tolerance is measured.
SaddleSolver::Outcome SaddleSolver::minimise(SaddlePreconditioner& B, const Problem& problem, Vector& x) {
  double target = -1;
  const auto finished = [&](double estimate, const Vector& now) {
    if (target >= 0 && estimate > target) return false;
    const double excess = measure(problem, now).larger() / options_.tolerance;
    if (excess <= 1) return true;
    target = target < 0 ? 2 * estimate / excess : estimate * std::clamp(0.8 / excess, 0.1, 0.7);
    return false;
  };
  const KrylovResult result = minimal_residuals(K_, B, problem.b, x, options_.max_iterations, K_.ranks(), finished);
  return {result.iterations, result.failure};
}

SaddleSolver::Outcome SaddleSolver::reduce_residual(SaddlePreconditioner& B, const Problem& problem, Vector& x) {
  constexpr int restart = 60;  // viscosity jumps of 1e5 take up to 45 iterations, twice as many if restarted earlier
  const WeightedOperator A{K_, coupled_, problem.weight};
  WeightedPreconditioner P{B, problem.weight};
  const KrylovLimits limits{0.95 * options_.tolerance, options_.max_iterations};
  const KrylovResult result = gmres(A, P, problem.b, x, limits, K_.ranks(), Directions::summed, restart);
  return {result.iterations, result.failure};
}

// GMRES with the triangular preconditioner takes half the iterations of MINRES with the diagonal one, but stores a
// vector for each iteration.
std::vector<SaddleSolver::Fallback> SaddleSolver::make_fallback_chain() const {
  return {{Krylov::gmres, options_.preconditioner, "standard", Start::warm},
          {Krylov::minres, "boomeramg", "strong", Start::cold},
          {Krylov::gmres, "boomeramg", "strong", Start::cold}};
}

SaddleSolver::Outcome SaddleSolver::attempt(const Fallback& fallback, const Problem& problem, Vector& x) {
  if (fallback.start == Start::cold) std::fill(x.begin(), x.end(), 0.0);
  SaddlePreconditioner& B = build(fallback.pressure, fallback.strength);
  if (std::string failure = B.refresh(); !failure.empty()) return {0, failure};
  return fallback.method == Krylov::minres ? minimise(B, problem, x) : reduce_residual(B, problem, x);
}

// x holds the best vector so far.
void SaddleSolver::try_fallback_chain(const Problem& problem, Vector& x, SaddleReport& report) {
  Vector y = x;
  int index = 0;
  for (const Fallback& fallback : make_fallback_chain()) {
    const Outcome result = attempt(fallback, problem, y);
    if (index++ < options_.fail_first) std::fill(y.begin(), y.end(), index % 2 ? 0.0 : NAN);
    project_pressure(y);
    const Residual residual = measure(problem, y);
    report.iterations += result.iterations;
    report.used = fallback.label();
    report.converged = residual.larger() <= options_.tolerance;
    if (report.converged || residual.larger() < report.residual) {
      x = y;
      report.set(residual.momentum, residual.continuity);
    }
    if (report.converged) return;
    report.failed_attempts.push_back(fmt::format(
        "{}: momentum {:.2e}, continuity {:.2e} after {} iterations{}{}", fallback.label(), residual.momentum,
        residual.continuity, result.iterations, result.failure.empty() ? "" : ", ", result.failure));
    if (!all_finite(y, K_.ranks())) y = x;
  }
}

void SaddleSolver::project_pressure(Vector& x) const {
  const auto faces = x.begin() + K_.velocities();
  Vector p(faces, faces + K_.pressures());
  coupled_.project(p);
  std::copy(p.begin(), p.end(), faces);
}

// Removes the part of q that no velocity can match. Returns |removed part| / |q|.
double SaddleSolver::make_compatible(Vector& q) const {
  const double before = norm(q, K_.ranks());
  Vector removed = q;
  coupled_.project(q);
  coupled_.project(q);  // again, for the round-off of the first means
  for (std::size_t i = 0; i < q.size(); ++i) removed[i] -= q[i];
  return before > 0 ? norm(removed, K_.ranks()) / before : 0;
}

void SaddleSolver::set_bodies(const BodyMatrix& H) {
  K_.set_bodies(H);
  if (K_.unknowns() > 0) coupled_.set_bodies(H);
}

SaddleReport SaddleSolver::solve(const BodyMatrix& H, const Vector& f, const Eigen::VectorXd& g, const Vector& q,
                                 Vector& u, Eigen::VectorXd& v, Vector& p, double flux_scale) {
  SaddleReport report;
  report.used = "none";
  set_bodies(H);
  if (const std::string bad = find_bad(f, g, q); !bad.empty()) {
    report.set(INFINITY, INFINITY);
    report.failed_attempts.push_back(bad);
    return report;
  }
  Vector reachable = q;
  report.mismatch = make_compatible(reachable);
  const Problem problem = pose(f, g, reachable, flux_scale);
  Vector x = K_.pack(u, v, p);
  if (!all_finite(x, K_.ranks())) std::fill(x.begin(), x.end(), 0.0);
  project_pressure(x);
  const Residual start = measure(problem, x);
  report.set(start.momentum, start.continuity);
  report.converged = start.larger() <= options_.tolerance && options_.fail_first == 0;
  if (!report.converged) try_fallback_chain(problem, x, report);
  K_.unpack(x, u, v, p);
  return report;
}

std::string SaddleSolver::find_bad(const Vector& f, const Eigen::VectorXd& g, const Vector& q) const {
  const Communicator& ranks = K_.ranks();
  const auto finite = [&](const std::vector<double>& values) { return all_finite(values, ranks); };
  if (!finite(K_.faces().values()) || !finite(K_.liquid().values()) || !finite(system_.D.value))
    return "the matrix is not finite";
  if (!finite(f) || !finite(q) || ranks.any(!g.allFinite())) return "the right-hand side is not finite";
  return {};
}

}  // namespace seiche
