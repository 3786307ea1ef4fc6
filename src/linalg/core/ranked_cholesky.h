#pragma once
// Cholesky factor of a sparse matrix that is positive semi-definite.
#include <vector>

#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// A = L L' on the rows that are independent of each other. A row depends on others if what is left of its diagonal
// entry beyond their part is at most `dependent`. Diagonal entries of A are 1, or 0 for empty rows.
//
// Rows are eliminated in an order of minimum degree, so that chains keep banded factors. A row whose pivot is small
// waits for the end. There the largest pivot goes first, since small ones in the wrong order make dependent rows come
// before independent ones (Higham 2002, 10.3).
class RankedCholesky {
 public:
  RankedCholesky() = default;
  RankedCholesky(const SparseMatrix& A, double dependent);

  // The independent rows, in the order of their pivots.
  const std::vector<int>& order() const { return order_; }
  // B <- A^+ B, 0 for dependent rows.
  void solve_in_place(Eigen::MatrixXd& B) const;

 private:
  // Column of L: its pivot row, and the rows of those eliminated later.
  struct Column {
    int pivot;
    double diagonal;
    std::vector<int> rows;
    std::vector<double> values;
  };

  void eliminate(const SparseMatrix& A, const std::vector<int>& order);
  void finish(const SparseMatrix& A, double dependent);

  std::vector<Column> columns_;
  std::vector<int> waiting_;  // rows left for the end
  std::vector<int> last_;     // those of them that are independent, in the order of their pivots
  Eigen::MatrixXd L_;         // lower factor of these
  std::vector<int> order_;
};

}  // namespace seiche
