#pragma once
// Solutions by LU factors with pivots, in one place: Eigen's templates for them take long to compile.
#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace seiche::testing {

// x with A x = b; A is square and regular.
Eigen::VectorXd dense_lu_solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

// The same; empty where a pivot is zero.
Eigen::VectorXd sparse_lu_solve(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& b);

}  // namespace seiche::testing
