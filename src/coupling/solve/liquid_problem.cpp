#include "coupling/solve/liquid_problem.h"

#include <fmt/format.h>

#include "coupling/solids/joint_bow.h"
#include "linalg/core/shared_columns.h"

namespace seiche {

template <int Dim>
LiquidProblem<Dim>::LiquidProblem(const SolidCoupling<Dim>& coupling, SpdSolver& solver, const NullSpace& closed,
                                  const Vector& b, Vector& pressure, double c1, double c2, const Communicator& ranks)
    : CoupledProblem<Dim>(coupling),
      solver_(solver),
      closed_(closed),
      b_(b),
      pressure_(pressure),
      c1_(c1),
      c2_(c2),
      ranks_(ranks),
      H_(ranks),
      none_(ranks) {
  Vector moved(b.size());
  add_multiplied(coupling.J, c1 * coupling.free, moved);
  scale_ = norm(b, ranks) + norm(moved, ranks);
}

// The mismatch is that of solves for the bodies: with given motion of the bodies it has no meaning.
template <int Dim>
std::string LiquidProblem<Dim>::solve(const BodyMatrix& H, const Vector& b) {
  SolveReport r = solver_.solve(H, b, pressure_, scale_);
  if (H.size() == 0) r.mismatch = report_.mismatch;
  add_up(r);
  if (r.converged) return {};
  return fmt::format("the pressure solve stopped at residual {:.2e} after {} iterations", r.residual, r.iterations);
}

template <int Dim>
void LiquidProblem<Dim>::add_up(const SolveReport& r) {
  report_.converged = r.converged;
  report_.iterations += r.iterations;
  report_.residual = std::max(report_.residual, r.residual);
  report_.rounding = std::max(report_.rounding, r.rounding);
  report_.mismatch = r.mismatch;
  report_.used = r.used;
  report_.identity_rows = r.identity_rows;
  report_.failed_attempts.insert(report_.failed_attempts.end(), r.failed_attempts.begin(), r.failed_attempts.end());
}

template <int Dim>
IndexRange LiquidProblem<Dim>::columns() const {
  return kkt_ ? share_of_rank(this->size(), ranks_) : IndexRange{0, this->size()};
}

template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::multiply(const SparseMatrix& K, const Eigen::VectorXd& v) const {
  return kkt_ ? multiply_shared(K, v, ranks_) : Eigen::VectorXd(K * v);
}

// A p + c1 J v = b,  H v - c2 J'p = M v* + r. Columns of J of fixed unknowns are zero.
template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise_together(const SparseMatrix& K, Eigen::VectorXd push) {
  SparseMatrix share;
  if (ranks_.size() > 1) share = with_columns(coupling_.mass, columns());
  const SparseMatrix& mass = ranks_.size() > 1 ? share : coupling_.mass;
  SparseMatrix H = K.nonZeros() > 0 ? SparseMatrix(mass + K) : mass;
  uncouple_held_shared(coupling_, ranks_, H, push);
  Eigen::VectorXd v = last_.size() == push.size() ? last_ : coupling_.free;
  const KktReport r = kkt_->solve(H, this->with_missing_fluxes(b_, -c1_), push, pressure_, v, scale_);
  if (r.indefinite) return indefinite_response();
  add_up({.converged = r.solve.converged,
          .iterations = r.solve.iterations,
          .residual = r.solve.residual,
          .used = r.solve.used,
          .failed_attempts = r.solve.failed_attempts,
          .identity_rows = report_.identity_rows,
          .mismatch = r.solve.mismatch});
  if (!r.solve.converged)
    return failed_response(
        fmt::format("the solve of pressures and bodies together stopped at residual {:.2e} after {} iterations",
                    r.solve.residual, r.solve.iterations));
  make_identical(v, ranks_);
  last_ = v;
  const Eigen::VectorXd force = impulse_of(pressure_);
  hold(v);
  return respond_with_pressure(v, force);
}

// c2 J'p, the same bits on all ranks, since each rank does the same contact solve.
template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::impulse_of(const Vector& pressure) const {
  Eigen::VectorXd impulse = c2_ * multiply_transposed(coupling_.J, pressure, ranks_);
  make_identical(impulse, ranks_);
  return impulse;
}

// Impulse of the mean pressures of closed components, the multipliers of chi'(J v) = given. Empty: bodies feel none.
template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::impulse_of_means() const {
  const std::vector<int>& sensed = solver_.sensed_components();
  if (sensed.empty()) return {};
  return impulse_of(component_means(closed_, sensed, pressure_, ranks_));
}

// c2 J_held'p
template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::impulse_on_held() const {
  if (!coupling_.any_held()) return Eigen::VectorXd::Zero(coupling_.size());
  Eigen::VectorXd impulse = c2_ * multiply_transposed(coupling_.J_held, pressure_, ranks_);
  make_identical(impulse, ranks_);
  return impulse;
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond_with_pressure(const Eigen::VectorXd& v,
                                                          const Eigen::VectorXd& force) const {
  const Eigen::VectorXd gradient = coupling_.mass * v - push_with_bow(coupling_) - force - impulse_on_held();
  return {{}, Shape::convex, v, gradient, -impulse_of_means()};
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise(const SparseMatrix& K, const Eigen::VectorXd& r) {
  Eigen::VectorXd push = push_with_bow(coupling_) + r;
  if (kkt_) return minimise_together(K, push);
  const bool known = K.nonZeros() == 0 && coupling_.joints && coupling_.joints->inertia;
  if (!known &&
      !H_.set(uncouple_held(coupling_, K.nonZeros() > 0 ? SparseMatrix(coupling_.mass + K) : coupling_.mass, push),
              coupling_.J.constraints))
    return indefinite_response();
  const BodyMatrix& H = known ? *coupling_.joints->inertia : H_;
  const Eigen::VectorXd dry = H.solve(push) + this->prescribed_by_joints(H);
  Vector b = this->with_missing_fluxes(b_, -c1_);
  add_multiplied(coupling_.J, -c1_ * free_part(dry), b);
  if (std::string failure = solve(H, b); !failure.empty()) return failed_response(failure);
  const Eigen::VectorXd force = impulse_of(pressure_);
  Eigen::VectorXd v = dry + H.solve(force);
  hold(v);
  return respond_with_pressure(v, force);
}

// b includes the fluxes of fixed unknowns at their prescribed velocities, whatever v has there.
template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond(const Eigen::VectorXd& v) {
  Vector b = this->with_missing_fluxes(b_, -c1_);
  add_multiplied(coupling_.J, -c1_ * free_part(v), b);
  if (std::string failure = solve(none_, b); !failure.empty()) return failed_response(failure);
  return respond_with_pressure(v, impulse_of(pressure_));
}

template class LiquidProblem<2>;
template class LiquidProblem<3>;

}  // namespace seiche
