#pragma once
// Factors of dense matrices, in one place: Eigen's templates for them take long to compile. Bases of columns.
#include <Eigen/Cholesky>

namespace seiche {

// A = P'L D L'P of a symmetric matrix, with pivots on the diagonal.
class DenseLdlt {
 public:
  DenseLdlt() = default;
  explicit DenseLdlt(const Eigen::MatrixXd& A) { compute(A); }
  void compute(const Eigen::MatrixXd& A);
  bool succeeded() const { return factor_.info() == Eigen::Success; }
  bool is_positive() const { return succeeded() && factor_.isPositive(); }  // no pivot below 0
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;

 private:
  Eigen::LDLT<Eigen::MatrixXd> factor_;
};

// A = L L' of a symmetric positive definite matrix.
class DenseLlt {
 public:
  DenseLlt() = default;
  explicit DenseLlt(const Eigen::MatrixXd& A) { compute(A); }
  void compute(const Eigen::MatrixXd& A);
  bool succeeded() const { return factor_.info() == Eigen::Success; }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;
  Eigen::VectorXd solve_lower(const Eigen::VectorXd& b) const;  // L^-1 b
  Eigen::VectorXd solve_upper(const Eigen::VectorXd& b) const;  // L'^-1 b
  void solve_lower_columns(Eigen::MatrixXd& B) const;           // B <- L^-1 B

 private:
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

// Factors D A D, D = diag(A)^(-1/2), whose diagonal is 1. Pivots are chosen and round-off is judged there, so that the
// unit of an unknown changes nothing. Rows with a diagonal of zero or less are left as they are.
class ScaledLdlt {
 public:
  explicit ScaledLdlt(const Eigen::MatrixXd& A);
  bool succeeded() const { return factor_.succeeded(); }
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;

 private:
  Eigen::VectorXd scale_;
  DenseLdlt factor_;
};

// x of least |A x - b|; a column that depends on others gets 0.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

// The shortest x of least |A x - b|.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

// Orthonormal basis of the span of A's columns, which have length 1. A column whose remainder beyond the others is
// below 1e-6 counts as dependent on them.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& A);

}  // namespace seiche
