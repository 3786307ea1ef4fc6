#pragma once
// Symmetric matrices of the bodies' unknowns whose columns are shared out over the ranks. Each rank's matrix has the
// size of the whole. Its own columns (share_of_rank) are filled and serve as rows; others are not read.
#include <Eigen/Dense>

#include "base/communicator.h"
#include "base/work_share.h"
#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// Rank r of R has n r/R <= i < n (r + 1)/R.
IndexRange share_of_rank(int n, const Communicator& ranks);

// Work that all ranks share.
class RankShare : public WorkShare {
 public:
  explicit RankShare(const Communicator& ranks) : ranks_(ranks) {}
  int processes() const override { return ranks_.size(); }
  IndexRange of(int n) const override { return share_of_rank(n, ranks_); }
  void add_up(std::span<double> values) const override;
  double least(double value) const override { return ranks_.global_min(value); }

 private:
  Communicator ranks_;
};

// The columns `own` of H in a matrix of its size; the others are empty.
SparseMatrix with_columns(const SparseMatrix& H, IndexRange own);

// Gives v on all ranks the entries of the ranks that own them. Collective.
void collect_shares(Eigen::VectorXd& v, const Communicator& ranks);

// H v and the diagonal of H, on all ranks. Collective.
Eigen::VectorXd multiply_shared(const SparseMatrix& H, const Eigen::VectorXd& v, const Communicator& ranks);
Eigen::VectorXd shared_diagonal(const SparseMatrix& H, const Communicator& ranks);

}  // namespace seiche
