#include "coupling/solve/coupled_problem.h"

#include "linalg/core/shared_columns.h"

namespace seiche {

InertiaResponse failed_response(const std::string& why) {
  return {why, Shape::convex, {}, {}};
}

InertiaResponse indefinite_response() {
  return {{}, Shape::indefinite, {}, {}};
}

namespace {

template <int Dim>
void drop_held(const SolidCoupling<Dim>& coupling, SparseMatrix& H) {
  H.prune(
      [&](Eigen::Index i, Eigen::Index j, double) { return i == j || (!coupling.is_held(i) && !coupling.is_held(j)); });
}

}  // namespace

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
bool CoupledProblem<Dim>::holds(const Eigen::VectorXd& v) const {
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (coupling_.is_held(i) && v[i] != coupling_.held[i]) return false;
  return true;
}

template <int Dim>
void CoupledProblem<Dim>::linearise_at(const Eigen::VectorXd& v) {
  for (std::size_t n = 0; n < missing_.size(); ++n) missing_[n] = coupling_.cavities[n].missing_flux(v);
}

template <int Dim>
Vector CoupledProblem<Dim>::with_missing_fluxes(Vector b, double by) const {
  for (std::size_t n = 0; n < missing_.size(); ++n)
    for (const int row : coupling_.cavities[n].rows) b[std::size_t(row)] += by * missing_[n];
  return b;
}

template SparseMatrix uncouple_held<2>(const SolidCoupling<2>&, const SparseMatrix&, Eigen::VectorXd&);
template SparseMatrix uncouple_held<3>(const SolidCoupling<3>&, const SparseMatrix&, Eigen::VectorXd&);
template void uncouple_held_shared<2>(const SolidCoupling<2>&, const Communicator&, SparseMatrix&, Eigen::VectorXd&);
template void uncouple_held_shared<3>(const SolidCoupling<3>&, const Communicator&, SparseMatrix&, Eigen::VectorXd&);
template class CoupledProblem<2>;
template class CoupledProblem<3>;

}  // namespace seiche
