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
std::string LiquidProblem<Dim>::solve(const SmallMatrix& H, const Vector& b) {
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
  return {{}, Shape::convex, v, coupling_.mass * (v - coupling_.target) - force};
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise(const SmallMatrix& K, const Eigen::VectorXd& r) {
  const SmallMatrix H = K.nonZeros() > 0 ? SmallMatrix(coupling_.mass + masked(K)) : coupling_.mass;
  const Eigen::SimplicialLLT<SmallMatrix> factor(H);
  if (size() > 0 && factor.info() != Eigen::Success) return indefinite();
  const Eigen::VectorXd push = coupling_.mass * coupling_.target + masked(r);
  const Eigen::VectorXd dry = factor.solve(push);
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * dry, b);
  if (std::string failure = solve(H, b); !failure.empty()) return failed(failure);
  const Eigen::VectorXd force = impulse_of_pressure();
  return respond_with_pressure(dry + factor.solve(force), force);
}

template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond(const Eigen::VectorXd& v) {
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * v, b);
  if (std::string failure = solve({}, b); !failure.empty()) return failed(failure);
  return respond_with_pressure(v, impulse_of_pressure());
}

template class LiquidProblem<2>;
template class LiquidProblem<3>;

}  // namespace seiche
