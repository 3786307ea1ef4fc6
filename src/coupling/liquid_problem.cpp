#include "coupling/liquid_problem.h"

#include <fmt/format.h>

namespace seiche {
template <int Dim>
LiquidProblem<Dim>::LiquidProblem(const SolidCoupling<Dim>& coupling, SpdSolver& solver, const Vector& b,
                                  Vector& pressure, double c1, double c2, const Communicator& ranks)
    : CoupledProblem<Dim>(coupling),
      solver_(solver),
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

template <int Dim>
std::string LiquidProblem<Dim>::solve(const BodyMatrix& H, const Vector& b) {
  const SolveReport r = solver_.solve(H, b, pressure_, scale_);
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
  return {{}, Shape::convex, v, coupling_.mass * v - coupling_.push - force};
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise(const SparseMatrix& K, const Eigen::VectorXd& r) {
  Eigen::VectorXd push = coupling_.push + r;
  if (!H_.set(uncouple_held(coupling_, K.nonZeros() > 0 ? SparseMatrix(coupling_.mass + K) : coupling_.mass, push)))
    return indefinite_response();
  const Eigen::VectorXd dry = H_.solve(push);
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * free_part(dry), b);
  if (std::string failure = solve(H_, b); !failure.empty()) return failed_response(failure);
  const Eigen::VectorXd force = impulse_of_pressure();
  Eigen::VectorXd v = dry + H_.solve(force);
  hold(v);
  return respond_with_pressure(v, force);
}

// While what is held is under way, b counts it as arrived.
template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond(const Eigen::VectorXd& v) {
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * free_part(v), b);
  if (std::string failure = solve(none_, b); !failure.empty()) return failed_response(failure);
  return respond_with_pressure(v, impulse_of_pressure());
}

template class LiquidProblem<2>;
template class LiquidProblem<3>;

}  // namespace seiche
