#pragma once
// The matrix H of the bodies (inertia, stiffness, contact) with its Cholesky factors; bodies that do not touch are
// factored separately. Joints add constraints C v = b. Solutions are then those on C v = 0: H^-1 stands for
//   H^-1 - H^-1 C'W^+ C H^-1,   W = C H^-1 C'.
#include <memory>
#include <vector>

#include "base/communicator.h"
#include "linalg/core/constraint_rows.h"
#include "linalg/core/small_blocks.h"
#include "linalg/core/sparse_ldlt.h"

namespace seiche {

// Each connected part of more than `shared_limit` unknowns is factored on one rank; parts are assigned by decreasing
// size to the rank with the least load. All smaller parts are factored together, on every rank.
class BodyMatrix {
 public:
  static constexpr int shared_limit = 1000;

  explicit BodyMatrix(const Communicator& ranks) : ranks_(ranks) {}

  // Factors H, which is the same on all ranks. False if it is not positive definite. Large parts whose rows and pattern
  // are unchanged reuse their ordering. `C`: constraints; no rows: none. Collective.
  [[nodiscard]] bool set(SparseMatrix H, const SparseMatrix& C = {});
  // Keeps H without factors; of several ranks each keeps its own columns (linalg/core/shared_columns.h).
  void keep(const SparseMatrix& H);
  bool is_shared_out() const { return shared_out_; }
  const SparseMatrix& matrix() const { return H_; }  // this rank's columns if H is shared out
  // On all ranks. Collective.
  Eigen::VectorXd diagonal() const;
  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const;
  int size() const { return int(H_.rows()); }
  const ConstraintRows& constraints() const { return constraints_; }
  // The part of v that C v = b prescribes: H^-1 C'W^+ b; 0 without constraints.
  Eigen::VectorXd prescribed(const Eigen::VectorXd& b) const;
  // Multipliers y of least |f + C'y| in the norm of H^-1: -W^+ C H^-1 f. Collective.
  Eigen::VectorXd multipliers_against(const Eigen::VectorXd& f) const;
  // H^-1 b, the same bits on all ranks. Collective.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  // H^-1 B, all columns at once.
  Eigen::MatrixXd solve_columns(const Eigen::MatrixXd& B) const;

 private:
  struct Part {
    std::vector<int> rows;  // ascending
    int owner = 0;
    SparseCholesky factor;
  };
  void find_parts();
  void share_out();
  SparseMatrix submatrix(const std::vector<int>& rows) const;
  bool factor_shared();
  Eigen::VectorXd solve_freely(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve_columns_freely(const Eigen::MatrixXd& B) const;
  SparseMatrix solve_rows_freely(const SparseMatrix& C) const;  // H^-1 C'

  Communicator ranks_;
  SparseMatrix H_;
  bool shared_out_ = false;
  std::vector<std::vector<int>> blocks_;  // rows of all connected parts
  SmallBlocks small_;                     // those of them that are small
  bool all_small_ = false;                // nothing else is factored
  std::vector<int> shared_;               // rows of parts up to shared_limit
  SparseLdlt shared_factor_;
  std::vector<Part> parts_;
  ConstraintRows constraints_;
};

}  // namespace seiche
