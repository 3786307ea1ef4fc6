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
LiquidProblem<Dim>::LiquidProblem(const SolidCoupling<Dim>& coupling, SpdSolver& solver, const Vector& b,
                                  Vector& pressure, double c1, double c2, const Communicator& ranks)
    : coupling_(coupling),
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

// v where it is free, zero where it is held.
template <int Dim>
Eigen::VectorXd LiquidProblem<Dim>::free_part(Eigen::VectorXd v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.freedom[std::size_t(i)] == Freedom::fixed) v[i] = 0;
  return v;
}

// H v = r with v known where it is held: H_ff v_f = r_f - H_fh v_h. Rows of what is held keep their diagonal.
template <int Dim>
SparseMatrix LiquidProblem<Dim>::uncouple_held(const SparseMatrix& H, Eigen::VectorXd& r) const {
  const auto is_held = [&](Eigen::Index i) { return coupling_.freedom[std::size_t(i)] == Freedom::fixed; };
  if (std::none_of(coupling_.freedom.begin(), coupling_.freedom.end(), [](Freedom f) { return f == Freedom::fixed; }))
    return H;
  r -= H * coupling_.held;
  SparseMatrix kept = H;
  kept.prune([&](Eigen::Index i, Eigen::Index j, double) { return i == j || (!is_held(i) && !is_held(j)); });
  for (Eigen::Index i = 0; i < r.size(); ++i)
    if (is_held(i)) r[i] = kept.coeff(i, i) * coupling_.held[i];
  return kept;
}

template <int Dim>
bool LiquidProblem<Dim>::holds(const Eigen::VectorXd& v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.freedom[std::size_t(i)] == Freedom::fixed && v[i] != coupling_.held[i]) return false;
  return true;
}

template <int Dim>
std::string LiquidProblem<Dim>::solve(const BodyMatrix& H, const Vector& b) {
  const SolveReport r = solver_.solve(H, b, pressure_, scale_);
  add_up(r);
  if (r.converged) return {};
  return fmt::format("the pressure solve stopped at residual {:.2e} after {} iterations", r.residual, r.iterations);
}

template <int Dim>
void LiquidProblem<Dim>::add_up(const SolveReport& r) {
  report_.converged = r.converged;
  report_.iterations += r.iterations;
  report_.residual = std::max(report_.residual, r.residual);
  report_.mismatch = r.mismatch;
  report_.used = r.used;
  report_.identity_rows = r.identity_rows;
  report_.ladder.insert(report_.ladder.end(), r.ladder.begin(), r.ladder.end());
}

// A p + c1 J v = b,  H v - c2 J'p = M v* + r. Columns of J of what is held are zero.
template <int Dim>
InertiaResponse LiquidProblem<Dim>::minimise_together(const SparseMatrix& K, Eigen::VectorXd push) {
  const SparseMatrix H = uncouple_held(K.nonZeros() > 0 ? SparseMatrix(coupling_.mass + K) : coupling_.mass, push);
  Eigen::VectorXd v = last_.size() == push.size() ? last_ : coupling_.free;
  const KktReport r = kkt_->solve(H, b_, push, pressure_, v, scale_);
  if (r.indefinite) return indefinite();
  add_up({.converged = r.solve.converged,
          .iterations = r.solve.iterations,
          .residual = r.solve.residual,
          .used = r.solve.used,
          .ladder = r.solve.ladder,
          .identity_rows = report_.identity_rows,
          .mismatch = r.solve.mismatch});
  if (!r.solve.converged)
    return failed(
        fmt::format("the solve of pressures and bodies together stopped at residual {:.2e} after {} iterations",
                    r.solve.residual, r.solve.iterations));
  make_identical(v, ranks_);
  last_ = v;
  const Eigen::VectorXd force = impulse_of_pressure();
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.freedom[std::size_t(i)] == Freedom::fixed) v[i] = coupling_.held[i];
  return respond_with_pressure(v, force);
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
  if (kkt_) return minimise_together(K, push);
  if (!H_.set(uncouple_held(K.nonZeros() > 0 ? SparseMatrix(coupling_.mass + K) : coupling_.mass, push)))
    return indefinite();
  const Eigen::VectorXd dry = H_.solve(push);
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * free_part(dry), b);
  if (std::string failure = solve(H_, b); !failure.empty()) return failed(failure);
  const Eigen::VectorXd force = impulse_of_pressure();
  Eigen::VectorXd v = dry + H_.solve(force);
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.freedom[std::size_t(i)] == Freedom::fixed) v[i] = coupling_.held[i];
  return respond_with_pressure(v, force);
}

// While what is held is under way, b counts it as arrived.
template <int Dim>
InertiaResponse LiquidProblem<Dim>::respond(const Eigen::VectorXd& v) {
  Vector b = b_;
  add_multiplied(coupling_.J, -c1_ * free_part(v), b);
  if (std::string failure = solve(none_, b); !failure.empty()) return failed(failure);
  return respond_with_pressure(v, impulse_of_pressure());
}

template class LiquidProblem<2>;
template class LiquidProblem<3>;

}  // namespace seiche
