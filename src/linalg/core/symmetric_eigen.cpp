#include "linalg/core/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace seiche {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace seiche
