#include "linalg/core/dense_factors.h"

#include <Eigen/QR>

namespace seiche {

void DenseLdlt::compute(const Eigen::MatrixXd& A) {
  factor_.compute(A);
}

Eigen::VectorXd DenseLdlt::solve(const Eigen::VectorXd& b) const {
  return factor_.solve(b);
}

Eigen::MatrixXd DenseLdlt::solve_columns(const Eigen::MatrixXd& B) const {
  return factor_.solve(B);
}

void DenseLlt::compute(const Eigen::MatrixXd& A) {
  factor_.compute(A);
}

Eigen::VectorXd DenseLlt::solve(const Eigen::VectorXd& b) const {
  return factor_.solve(b);
}

Eigen::MatrixXd DenseLlt::solve_columns(const Eigen::MatrixXd& B) const {
  return factor_.solve(B);
}

Eigen::VectorXd DenseLlt::solve_lower(const Eigen::VectorXd& b) const {
  return factor_.matrixL().solve(b);
}

Eigen::VectorXd DenseLlt::solve_upper(const Eigen::VectorXd& b) const {
  return factor_.matrixU().solve(b);
}

void DenseLlt::solve_lower_columns(Eigen::MatrixXd& B) const {
  factor_.matrixL().solveInPlace(B);
}

ScaledLdlt::ScaledLdlt(const Eigen::MatrixXd& A)
    : scale_(A.diagonal().unaryExpr([](double a) { return a > 0 ? 1 / std::sqrt(a) : 1; })) {
  factor_.compute(scale_.asDiagonal() * A * scale_.asDiagonal());
}

Eigen::VectorXd ScaledLdlt::solve(const Eigen::VectorXd& b) const {
  return scale_.cwiseProduct(factor_.solve(scale_.cwiseProduct(b)));
}

Eigen::MatrixXd ScaledLdlt::solve_columns(const Eigen::MatrixXd& B) const {
  return scale_.asDiagonal() * factor_.solve_columns(scale_.asDiagonal() * B);
}

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}

Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(A).solve(b);
}

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& A) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  qr.setThreshold(1e-6);
  return qr.householderQ() * Eigen::MatrixXd::Identity(A.rows(), qr.rank());
}

}  // namespace seiche
