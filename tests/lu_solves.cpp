#include "lu_solves.h"

#include <Eigen/LU>
#include <Eigen/SparseLU>

namespace seiche::testing {

Eigen::VectorXd dense_lu_solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.partialPivLu().solve(b);
}

Eigen::VectorXd sparse_lu_solve(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& b) {
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(A);
  return lu.info() == Eigen::Success ? Eigen::VectorXd(lu.solve(b)) : Eigen::VectorXd();
}

}  // namespace seiche::testing
