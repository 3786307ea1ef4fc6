#pragma once
// LDL' factors of a sparse symmetric matrix on one rank, in one place: Eigen's template takes long to compile.
#include <Eigen/SparseCholesky>

#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// For quasi-definite matrices, too. Without pivots; the ordering is of least degree.
class SparseLdlt {
 public:
  // False if a pivot is zero.
  [[nodiscard]] bool factor(const SparseMatrix& A);
  bool is_positive() const;  // all pivots above 0
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;

 private:
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

}  // namespace seiche
