#include "coupling/liquid_problem.h"

#include <fmt/format.h>

namespace seiche {
namespace {

InertiaResponse failed(const std::string& why) {
  return {why, Shape::convex, {}, {}};
}

InertiaResponse indefinite() {
  return {{}, Shape::indefinite, {}, {}};
}

}  // namespace

template <int Dim>
LiquidProblem<Dim>::LiquidProblem(const RigidCoupling<Dim>& coupling, SpdSolver& solver, const Vector& b,
                                  Vector& pressure, double c1, double c2, const Communicator& ranks)
    : coupling_(coupling), solver_(solver), b_(b), pressure_(pressure), c1_(c1), c2_(c2), ranks_(ranks) {
  Vector moved(b.size());
  add_multiplied(coupling.J, c1 * coupling.free, moved);
  scale_ = norm(b, ranks) + norm(moved, ranks);
}

template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::masked(Eigen::VectorXd v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.freedom[i] == Freedom::fixed) v[i] = 0;
  return v;
}

template <int Dim>
SmallMatrix LiquidProblem<Dim>::masked(const SmallMatrix& K) const {
  SmallMatrix kept = K;
  kept.prune([&](Eigen::Index i, Eigen::Index j, double) {
    return coupling_.freedom[i] == Freedom::free && coupling_.freedom[j] == Freedom::free;
  });
  return kept;
}

template <int Dim>
std::string LiquidProblem<Dim>::solve(const SmallMatrix& H, const Vector& b, Vector& p, double scale) {
  const SolveReport r = solver_.solve(H, b, p, scale);
  report_.converged = r.converged;
  report_.iterations += r.iterations;
  report_.residual = std::max(report_.residual, r.residual);
  report_.mismatch = r.mismatch;
  report_.used = r.used;
  report_.identity_rows = r.identity_rows;
  report_.ladder.insert(report_.ladder.end(), r.ladder.begin(), r.ladder.end());
  if (r.converged) return {};
  return fmt::format("the pressure solve stopped at residual {:.2e} after {} iterations", r.residual, r.iterations);
}

// c2 J'p, the same bits on all ranks: they all go through the same contact solve.
template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::impulse_of_pressure() const {
  Eigen::VectorXd impulse = c2_ * multiply_transposed(coupling_.J, pressure_, ranks_);
  make_identical(impulse, ranks_);
  return impulse;
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond_with_pressure(const Eigen::VectorXd& v,
                                                          const Eigen::VectorXd& force) const {
  return {{}, Shape::convex, v, coupling_.mass * (v - coupling_.target) - force};
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise(const SmallMatrix& K, const Eigen::VectorXd& r) {
  if (added_) return minimise_with_added_mass(K, r);
  if (++coupled_solves_ > solves_before_added_mass() && can_build_added_mass()) {
    if (std::string failure = build_added_mass(); !failure.empty()) return failed(failure);
    return minimise_with_added_mass(K, r);
  }
  const SmallMatrix H = K.nonZeros() > 0 ? SmallMatrix(coupling_.mass + masked(K)) : coupling_.mass;
  const Eigen::SimplicialLLT<SmallMatrix> factor(H);
  if (size() > 0 && factor.info() != Eigen::Success) return indefinite();
  const Eigen::VectorXd push = coupling_.mass * coupling_.target + masked(r);
  const Eigen::VectorXd dry = factor.solve(push);
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * dry, b);
  if (std::string failure = solve(H, b, pressure_, scale_); !failure.empty()) return failed(failure);
  const Eigen::VectorXd force = impulse_of_pressure();
  return respond_with_pressure(dry + factor.solve(force), force);
}

// One solve a column pays at once for a body or two; for more, contact must prove stubborn first.
template <int Dim>
int LiquidProblem<Dim>::solves_before_added_mass() const {
  constexpr int few_columns = 12;
  return size() <= few_columns ? 3 : 2 * size();
}

// Where A is singular but for the bodies, A^-1 J does not exist; and A^-1 J is dense.
template <int Dim>
bool LiquidProblem<Dim>::can_build_added_mass() const {
  constexpr double most_bytes = 5e8;
  const double bytes = ranks_.global_max(double(pressure_.size())) * size() * sizeof(double);
  return solver_.sensed_components().empty() && bytes <= most_bytes;
}

template <int Dim>
std::string LiquidProblem<Dim>::build_added_mass() {
  auto added = std::make_unique<AddedMass>();
  added->p0 = pressure_;
  if (std::string failure = solve({}, b_, added->p0, scale_); !failure.empty()) return failure;
  added->G = Eigen::MatrixXd::Zero(size(), size());
  added->columns.resize(std::size_t(size()));
  for (int k = 0; k < size(); ++k) {
    Vector column(pressure_.size()), x(pressure_.size());
    add_multiplied(coupling_.J, Eigen::VectorXd::Unit(size(), k), column);
    const double length = norm(column, ranks_);
    if (length == 0) continue;
    if (std::string failure = solve({}, column, x, length); !failure.empty()) return failure;
    added->G.col(k) = c1_ * c2_ * multiply_transposed(coupling_.J, x, ranks_);
    added->columns[std::size_t(k)] = std::move(x);
  }
  added->G = 0.5 * (added->G + added->G.transpose()).eval();
  added->impulse = c2_ * multiply_transposed(coupling_.J, added->p0, ranks_);
  make_identical(added->impulse, ranks_);
  Eigen::VectorXd entries = added->G.reshaped();
  make_identical(entries, ranks_);
  added->G = entries.reshaped(size(), size());
  added_ = std::move(added);
  return {};
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise_with_added_mass(const SmallMatrix& K, const Eigen::VectorXd& r) const {
  Eigen::MatrixXd T = coupling_.mass;
  T += added_->G;
  if (K.nonZeros() > 0) T += masked(K);
  const Eigen::VectorXd push = coupling_.mass * coupling_.target + masked(r) + added_->impulse;
  const Eigen::LLT<Eigen::MatrixXd> factor(T);
  if (factor.info() != Eigen::Success) return indefinite();
  const Eigen::VectorXd v = factor.solve(push);
  return respond_with_pressure(v, added_->impulse - added_->G * v);
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond(const Eigen::VectorXd& v) {
  if (added_) {
    pressure_ = added_->p0;
    for (int k = 0; k < size(); ++k)
      if (!added_->columns[std::size_t(k)].empty()) add_scaled(pressure_, -c1_ * v[k], added_->columns[std::size_t(k)]);
  }
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * v, b);
  if (std::string failure = solve({}, b, pressure_, scale_); !failure.empty()) return failed(failure);
  return respond_with_pressure(v, impulse_of_pressure());
}

template class LiquidProblem<2>;
template class LiquidProblem<3>;

}  // namespace seiche
