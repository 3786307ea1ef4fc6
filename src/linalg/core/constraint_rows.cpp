#include "linalg/core/constraint_rows.h"

#include <algorithm>

namespace seiche {

ConstraintRows::ConstraintRows(const SparseMatrix& C, const Eigen::MatrixXd& X)
    : ConstraintRows(C, SparseMatrix(X.sparseView())) {}

ConstraintRows::ConstraintRows(const SparseMatrix& C, SparseMatrix X) : C_(C), X_(std::move(X)) {
  constexpr double dependent = 1e-10;
  SparseMatrix W = C_ * X_;
  W = SparseMatrix(0.5 * (W + SparseMatrix(W.transpose())));
  scale_ = W.diagonal().unaryExpr([](double w) { return w > 0 ? 1 / std::sqrt(w) : 0.0; });
  factor_ = RankedCholesky(scale_.asDiagonal() * W * scale_.asDiagonal(), dependent);
}

std::vector<int> ConstraintRows::independent() const {
  std::vector<int> rows = factor_.order();
  std::sort(rows.begin(), rows.end());
  return rows;
}

Eigen::MatrixXd ConstraintRows::solve(const Eigen::MatrixXd& B) const {
  Eigen::MatrixXd Y = scale_.asDiagonal() * B;
  factor_.solve_in_place(Y);
  return scale_.asDiagonal() * Y;
}

Eigen::VectorXd ConstraintRows::multipliers(const Eigen::VectorXd& b) const {
  return solve(b);
}

// Twice: light bodies leave round-off of their large y.
Eigen::VectorXd ConstraintRows::moved_onto(const Eigen::VectorXd& y, const Eigen::VectorXd& b) const {
  const Eigen::VectorXd v = y - X_ * solve(C_ * y - b);
  return v - X_ * solve(C_ * v - b);
}

Eigen::MatrixXd ConstraintRows::moved_onto_zero(const Eigen::MatrixXd& Y) const {
  const Eigen::MatrixXd V = Y - X_ * solve(C_ * Y);
  return V - X_ * solve(C_ * V);
}

Eigen::VectorXd ConstraintRows::without_multipliers(const Eigen::VectorXd& f) const {
  return f - C_.transpose() * solve(X_.transpose() * f);
}

}  // namespace seiche
