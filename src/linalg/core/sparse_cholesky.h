#pragma once
// Cholesky factors of a sparse symmetric positive definite matrix on one rank.
#include <Eigen/SparseCore>
#include <memory>

namespace seiche {

using SparseMatrix = Eigen::SparseMatrix<double>;

class SparseCholesky {
 public:
  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  // False if A is not positive definite. Analyses (ordering and structure of the factor) depend on the pattern of A
  // alone. Those made last are kept for all objects of the process and used again for the same pattern.
  [[nodiscard]] bool factor(const SparseMatrix& A);
  // A^-1 b, after a call of factor() that returned true.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  // A^-1 B, all columns at once.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;

 private:
  struct Factors;
  struct Analyses;
  std::unique_ptr<Factors> factors_;
};

}  // namespace seiche
