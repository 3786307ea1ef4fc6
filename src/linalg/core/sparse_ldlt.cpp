#include "linalg/core/sparse_ldlt.h"

namespace seiche {

bool SparseLdlt::factor(const SparseMatrix& A) {
  factor_.compute(A);
  return factor_.info() == Eigen::Success;
}

bool SparseLdlt::is_positive() const {
  return (factor_.vectorD().array() > 0).all();
}

Eigen::VectorXd SparseLdlt::solve(const Eigen::VectorXd& b) const {
  return factor_.solve(b);
}

Eigen::MatrixXd SparseLdlt::solve_columns(const Eigen::MatrixXd& B) const {
  return factor_.solve(B);
}

}  // namespace seiche
