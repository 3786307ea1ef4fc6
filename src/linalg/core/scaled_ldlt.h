#pragma once
// Factors of a dense symmetric positive matrix whose unknowns differ in units.
#include <Eigen/Cholesky>

namespace seiche {

// Factors D A D, D = diag(A)^(-1/2), whose diagonal is 1. Pivots are chosen and round-off is judged there, so that the
// unit of an unknown changes nothing. Rows with a diagonal of zero or less are left as they are.
class ScaledLdlt {
 public:
  explicit ScaledLdlt(const Eigen::MatrixXd& A) : scale_(scales(A.diagonal())) {
    factor_.compute(scale_.asDiagonal() * A * scale_.asDiagonal());
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const {
    return scale_.asDiagonal() * factor_.solve(scale_.asDiagonal() * b);
  }
  Eigen::ComputationInfo info() const { return factor_.info(); }

 private:
  static Eigen::VectorXd scales(const Eigen::VectorXd& diagonal) {
    return diagonal.unaryExpr([](double a) { return a > 0 ? 1 / std::sqrt(a) : 1; });
  }

  Eigen::VectorXd scale_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

}  // namespace seiche
