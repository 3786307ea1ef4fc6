#include "coupling/solve/coupled_problem.h"

#include "linalg/core/shared_columns.h"

namespace seiche {

InertiaResponse failed_response(const std::string& why) {
  return {why, Shape::convex, {}, {}};
}

InertiaResponse indefinite_response() {
  return {{}, Shape::indefinite, {}, {}};
}

Vector component_means(const NullSpace& closed, const std::vector<int>& sensed, const Vector& p,
                       const Communicator& ranks) {
  std::vector<double> sums(2 * sensed.size());
  std::vector<std::size_t> place(std::size_t(closed.count), sensed.size());
  for (std::size_t k = 0; k < sensed.size(); ++k) place[std::size_t(sensed[k])] = k;
  const auto place_of = [&](std::size_t row) {
    return closed.component[row] < 0 ? sensed.size() : place[std::size_t(closed.component[row])];
  };
  for (std::size_t i = 0; i < p.size(); ++i)
    if (const std::size_t k = place_of(i); k < sensed.size()) sums[2 * k] += p[i], sums[2 * k + 1] += 1;
  ranks.global_sum(sums);
  Vector means(p.size());
  for (std::size_t i = 0; i < means.size(); ++i)
    if (const std::size_t k = place_of(i); k < sensed.size()) means[i] = sums[2 * k] / sums[2 * k + 1];
  return means;
}

namespace {

template <int Dim>
void drop_held(const SolidCoupling<Dim>& coupling, SparseMatrix& H) {
  H.prune(
      [&](Eigen::Index i, Eigen::Index j, double) { return i == j || (!coupling.is_held(i) && !coupling.is_held(j)); });
}

}  // namespace

// Up to round-off: rows of C v that add up to 0.
template <int Dim>
bool holds_joints(const SolidCoupling<Dim>& coupling, const Eigen::VectorXd& v) {
  constexpr double rounding = 1e-9;
  const SparseMatrix& C = coupling.J.constraints;
  const JointMotion<Dim>& joints = *coupling.joints;
  const Eigen::VectorXd missing = (C * v - joints.rate).cwiseAbs(), size = C.cwiseAbs() * v.cwiseAbs();
  return (missing.array() <= rounding * (size + joints.rate.cwiseAbs()).array() + joints.slack.array()).all();
}

template <int Dim>
SparseMatrix uncouple_held(const SolidCoupling<Dim>& coupling, const SparseMatrix& H, Eigen::VectorXd& r) {
  if (!coupling.any_held()) return H;
  r -= H * coupling.held;
  SparseMatrix kept = H;
  drop_held(coupling, kept);
  for (Eigen::Index i = 0; i < r.size(); ++i)
    if (coupling.is_held(i)) r[i] = kept.coeff(i, i) * coupling.held[i];
  return kept;
}

template <int Dim>
void uncouple_held_shared(const SolidCoupling<Dim>& coupling, const Communicator& ranks, SparseMatrix& H,
                          Eigen::VectorXd& r) {
  if (!coupling.any_held()) return;
  r -= multiply_shared(H, coupling.held, ranks);
  const Eigen::VectorXd diagonal = shared_diagonal(H, ranks);
  for (Eigen::Index i = 0; i < r.size(); ++i)
    if (coupling.is_held(i)) r[i] = diagonal[i] * coupling.held[i];
  drop_held(coupling, H);
}

template <int Dim>
Eigen::VectorXd CoupledProblem<Dim>::free_part(Eigen::VectorXd v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.is_held(i)) v[i] = 0;
  return v;
}

template <int Dim>
void CoupledProblem<Dim>::hold(Eigen::VectorXd& v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.is_held(i)) v[i] = coupling_.held[i];
}

template <int Dim>
Eigen::VectorXd CoupledProblem<Dim>::prescribed_by_joints(const BodyMatrix& H) const {
  return coupling_.is_constrained() ? H.prescribed(coupling_.joints->rate) : Eigen::VectorXd::Zero(coupling_.size());
}

template <int Dim>
bool CoupledProblem<Dim>::holds(const Eigen::VectorXd& v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.is_held(i) && v[i] != coupling_.held[i]) return false;
  return !coupling_.is_constrained() || holds_joints(coupling_, v);
}

// Fixed unknowns have reached their velocities by the next minimum, whatever v has there: a constraint that changed
// with them would leave no direction downhill.
template <int Dim>
void CoupledProblem<Dim>::linearise_at(const Eigen::VectorXd& v) {
  if (missing_.empty()) return;
  Eigen::VectorXd held = v;
  hold(held);
  for (std::size_t n = 0; n < missing_.size(); ++n) missing_[n] = coupling_.cavities[n].missing_flux(held);
}

template <int Dim>
Vector CoupledProblem<Dim>::with_missing_fluxes(Vector b, double by) const {
  for (std::size_t n = 0; n < missing_.size(); ++n)
    for (const auto& [row, share] : coupling_.cavities[n].rows) b[std::size_t(row)] += by * share * missing_[n];
  return b;
}

template SparseMatrix uncouple_held<2>(const SolidCoupling<2>&, const SparseMatrix&, Eigen::VectorXd&);
template SparseMatrix uncouple_held<3>(const SolidCoupling<3>&, const SparseMatrix&, Eigen::VectorXd&);
template void uncouple_held_shared<2>(const SolidCoupling<2>&, const Communicator&, SparseMatrix&, Eigen::VectorXd&);
template void uncouple_held_shared<3>(const SolidCoupling<3>&, const Communicator&, SparseMatrix&, Eigen::VectorXd&);
template bool holds_joints<2>(const SolidCoupling<2>&, const Eigen::VectorXd&);
template bool holds_joints<3>(const SolidCoupling<3>&, const Eigen::VectorXd&);
template class CoupledProblem<2>;
template class CoupledProblem<3>;

}  // namespace seiche
