#pragma once
// Linear constraints C v = b on unknowns v with a positive definite matrix H, by their multipliers.
#include <vector>

#include "linalg/core/ranked_cholesky.h"

namespace seiche {

// With X = H^-1 C' and W = C X, minima of v'Hv/2 - r'v on C v = b are
//   v = y - X W^+ (C y - b),   y = H^-1 r.
// W may be singular: rows that depend on others (closed loops of joints) drop out. A row depends on others if its part
// of W beyond theirs is below 1e-10 of its own diagonal entry.
class ConstraintRows {
 public:
  // No constraints.
  ConstraintRows() = default;
  // X: one column a row of C.
  ConstraintRows(const SparseMatrix& C, SparseMatrix X);
  ConstraintRows(const SparseMatrix& C, const Eigen::MatrixXd& X);

  bool empty() const { return C_.rows() == 0; }
  const SparseMatrix& rows() const { return C_; }
  // Rows that are independent of each other, ascending.
  std::vector<int> independent() const;
  // W^+ b, 0 for dependent rows.
  Eigen::VectorXd multipliers(const Eigen::VectorXd& b) const;
  // y - X W^+ (C y - b); b = 0 for the second and the third. The third is its transpose: f - C'W^+ X'f.
  Eigen::VectorXd moved_onto(const Eigen::VectorXd& y, const Eigen::VectorXd& b) const;
  Eigen::MatrixXd moved_onto_zero(const Eigen::MatrixXd& Y) const;
  Eigen::VectorXd without_multipliers(const Eigen::VectorXd& f) const;

 private:
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;

  SparseMatrix C_, X_;
  Eigen::VectorXd scale_;  // W_ii^(-1/2); 0 for empty rows
  RankedCholesky factor_;  // of the scaled W
};

}  // namespace seiche
