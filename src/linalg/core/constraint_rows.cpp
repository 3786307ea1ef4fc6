#include "linalg/core/constraint_rows.h"

#include <algorithm>

namespace seiche {

namespace {

// Cholesky factor with complete pivoting of a semi-definite matrix: A(order, order) ~ L L'. Each step takes the row of
// the largest remaining diagonal entry, and the last one is followed by entries up to `least` (Higham 2002, 10.3).
struct PivotedCholesky {
  std::vector<int> order;
  Eigen::MatrixXd L;

  PivotedCholesky(Eigen::MatrixXd A, double least) {
    const Eigen::Index n = A.rows();
    Eigen::MatrixXd columns(n, n);
    Eigen::VectorXd left = A.diagonal();
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::Index pivot = 0;
      if (left.maxCoeff(&pivot) <= least) break;
      columns.col(k) = A.col(pivot);
      columns.col(k).noalias() -= columns.leftCols(k) * columns.row(pivot).head(k).transpose();
      columns.col(k) /= std::sqrt(left[pivot]);
      left -= columns.col(k).cwiseAbs2();
      left[pivot] = 0;
      order.push_back(int(pivot));
    }
    const auto rank = Eigen::Index(order.size());
    L.setZero(rank, rank);
    for (Eigen::Index k = 0; k < rank; ++k) L.row(k).head(k + 1) = columns.row(order[std::size_t(k)]).head(k + 1);
  }
};

}  // namespace

ConstraintRows::ConstraintRows(const SparseMatrix& C, Eigen::MatrixXd X) : C_(C), X_(std::move(X)) {
  constexpr double dependent = 1e-10;
  Eigen::MatrixXd W = C_ * X_;
  W = (0.5 * (W + W.transpose())).eval();
  scale_ = W.diagonal().unaryExpr([](double w) { return w > 0 ? 1 / std::sqrt(w) : 0.0; });
  PivotedCholesky factor(scale_.asDiagonal() * W * scale_.asDiagonal(), dependent);
  order_ = std::move(factor.order);
  L_ = std::move(factor.L);
}

std::vector<int> ConstraintRows::independent() const {
  std::vector<int> rows = order_;
  std::sort(rows.begin(), rows.end());
  return rows;
}

Eigen::MatrixXd ConstraintRows::solve(const Eigen::MatrixXd& B) const {
  const Eigen::MatrixXd scaled = scale_.asDiagonal() * B;
  Eigen::MatrixXd Y = scaled(order_, Eigen::all);
  L_.triangularView<Eigen::Lower>().solveInPlace(Y);
  L_.triangularView<Eigen::Lower>().transpose().solveInPlace(Y);
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(B.rows(), B.cols());
  all(order_, Eigen::all) = Y;
  return scale_.asDiagonal() * all;
}

Eigen::VectorXd ConstraintRows::multipliers(const Eigen::VectorXd& b) const {
  return solve(b);
}

Eigen::VectorXd ConstraintRows::moved_onto(const Eigen::VectorXd& y, const Eigen::VectorXd& b) const {
  return y - X_ * solve(C_ * y - b);
}

Eigen::MatrixXd ConstraintRows::moved_onto_zero(const Eigen::MatrixXd& Y) const {
  return Y - X_ * solve(C_ * Y);
}

Eigen::VectorXd ConstraintRows::without_multipliers(const Eigen::VectorXd& f) const {
  return f - C_.transpose() * solve(X_.transpose() * f);
}

}  // namespace seiche
