#include "linalg/spd/coupled_system.h"

#include "linalg/core/dense_factors.h"
#include "linalg/core/symmetric_eigen.h"

namespace seiche {
namespace {

// The part of each column that motions on C v = 0 feel: less its projection on the range of C'. Results below round-off
// are set to zero. Bodies do not feel what the constraints hold alone.
Eigen::MatrixXd felt_beside(const SparseMatrix& C, const Eigen::MatrixXd& sums) {
  const Eigen::MatrixXd held = Eigen::MatrixXd(C.transpose());
  const auto norms = held.colwise().norm().array();
  const Eigen::MatrixXd basis = orthonormal_basis(held * (norms > 0).select(norms.inverse(), 0).matrix().asDiagonal());
  Eigen::MatrixXd felt = sums - basis * (basis.transpose() * sums);
  for (Eigen::Index c = 0; c < sums.cols(); ++c) {
    const double rounding = 1e-9 * sums.col(c).lpNorm<Eigen::Infinity>();
    felt.col(c) = (felt.col(c).array().abs() > rounding).select(felt.col(c), 0.0);
  }
  return felt;
}

// J' chi for the indicator chi of each component of the null space of A; `sizes` has the sums of absolute values. Sums
// below their round-off are set to zero.
struct Felt {
  Eigen::MatrixXd sums, sizes;
};

Felt feel_components(const LinearSystem& A, const BlockColumns& J) {
  const NullSpace& null_space = A.null_space();
  Felt felt{Eigen::MatrixXd::Zero(J.columns(), null_space.count), Eigen::MatrixXd::Zero(J.columns(), null_space.count)};
  J.for_each([&](int i, int k, double value) {
    const int c = null_space.component.empty() ? -1 : null_space.component[i];
    if (c < 0) return;
    felt.sums(k, c) += value;
    felt.sizes(k, c) += std::abs(value);
  });
  if (felt.sums.size() == 0) return felt;
  A.ranks().global_sum(std::span<double>(felt.sums.data(), std::size_t(felt.sums.size())));
  A.ranks().global_sum(std::span<double>(felt.sizes.data(), std::size_t(felt.sizes.size())));
  // Round-off of sums of up to 1e6 terms.
  const auto rounding = 1e-11 * felt.sizes.array();
  felt.sums = (felt.sums.array().abs() > rounding).select(felt.sums, 0.0);
  if (J.constraints.rows() > 0) felt.sums = felt_beside(J.constraints, felt.sums);
  return felt;
}

}  // namespace

NullSpace without(NullSpace null_space, const std::vector<int>& components) {
  for (int& c : null_space.component)
    if (std::find(components.begin(), components.end(), c) != components.end()) c = -1;
  return null_space;
}

CoupledSystem::CoupledSystem(const LinearSystem& A, const BlockColumns& J, double c)
    : A_(A), J_(J), c_(c), unsensed_means_({}, A.ranks()) {
  find_sensed();
}

// Null space of S: constants on the components of A that no body feels (J' chi = 0), and combinations of the other
// components that no body feels.
void CoupledSystem::find_sensed() {
  const Felt felt = feel_components(A_, J_);
  for (int c = 0; c < felt.sums.cols(); ++c)
    if (!felt.sums.col(c).isZero(0)) sensed_.push_back(c);
  unsensed_means_ = MeanRemover(without(A_.null_space(), sensed_), A_.ranks());
  if (sensed_.empty()) return;
  const int n = int(sensed_.size());
  sensed_rows_.assign(std::size_t(n), 0.0);
  for (const int c : A_.null_space().component)
    for (int k = 0; k < n; ++k) sensed_rows_[k] += c == sensed_[k];
  A_.ranks().global_sum(sensed_rows_);
  Eigen::MatrixXd C(felt.sums.rows(), n);
  for (int k = 0; k < n; ++k) C.col(k) = felt.sums.col(sensed_[k]);
  const SymmetricEigen eigen = symmetric_eigen(C.transpose() * C);
  int zeros = 0;
  // Eigenvalues are squares of sums with a relative round-off of 1e-11.
  while (zeros < n && eigen.values[zeros] <= 1e-20 * eigen.values[n - 1]) ++zeros;
  combinations_ = eigen.vectors.leftCols(zeros);
}

Eigen::VectorXd CoupledSystem::weigh(const Eigen::VectorXd& w) const {
  return c_ * H_->solve(w);
}

Eigen::MatrixXd CoupledSystem::weigh_columns(const Eigen::MatrixXd& W) const {
  return c_ * H_->solve_columns(W);
}

void CoupledSystem::multiply(const Vector& x, Vector& y) const {
  A_.multiply(x, y);
  if (is_coupled()) add_multiplied(J_, weigh(multiply_transposed(J_, x, ranks())), y);
}

void CoupledSystem::residual(const Vector& b, const Vector& x, Vector& r) const {
  A_.residual(b, x, r);
  if (is_coupled()) add_multiplied(J_, -weigh(multiply_transposed(J_, x, ranks())), r);
}

// v -= chi N (N' W N)^-1 N' chi' v, W the number of rows of each component, N = combinations_.
void CoupledSystem::project(Vector& v) const {
  if (!is_coupled()) return A_.project(v);
  for (const int i : A_.identity_list()) v[i] = 0;
  unsensed_means_.apply(v);
  if (combinations_.cols() == 0) return;
  const auto& component = A_.null_space().component;
  std::vector<double> sums(sensed_.size());
  for (std::size_t i = 0; i < component.size(); ++i)
    for (std::size_t k = 0; k < sensed_.size(); ++k)
      if (component[i] == sensed_[k]) sums[k] += v[i];
  ranks().global_sum(sums);
  const Eigen::Map<const Eigen::VectorXd> s(sums.data(), Eigen::Index(sums.size()));
  const Eigen::Map<const Eigen::VectorXd> W(sensed_rows_.data(), Eigen::Index(sums.size()));
  const Eigen::MatrixXd small = combinations_.transpose() * W.asDiagonal() * combinations_;
  const Eigen::VectorXd part = combinations_ * DenseLdlt(small).solve(combinations_.transpose() * s);
  for (std::size_t i = 0; i < component.size(); ++i)
    for (std::size_t k = 0; k < sensed_.size(); ++k)
      if (component[i] == sensed_[k]) v[i] -= part[Eigen::Index(k)];
}

}  // namespace seiche
