#pragma once
// Eigenvalues of dense symmetric matrices, in one place: Eigen's solver takes long to compile.
#include <Eigen/Dense>

namespace seiche {

// A = V diag(values) V', values ascending, a column of V each.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

// Both read the lower triangle of A.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);  // ascending; a third of the work

// V diag(max(values, 0)) V': the nearest positive semi-definite matrix to V diag(values) V'.
Eigen::MatrixXd positive_part(const SymmetricEigen& eigen);

}  // namespace seiche
