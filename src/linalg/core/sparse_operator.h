#pragma once
// Products with a distributed matrix that need not be square.
#include "linalg/core/column_halo.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

// Keeps a reference to the matrix.
class SparseOperator {
 public:
  // Columns are the entries of a vector of which this rank owns `owned`, numbered from `first`. Collective.
  SparseOperator(const DistributedMatrix& A, Row first, int owned, const Communicator& ranks);

  int rows() const { return A_.rows(); }
  int owned_columns() const { return halo_.owned(); }
  // y += A x, y of rows() entries at least, x of owned_columns(). Collective.
  void add_multiplied(std::span<const double> x, std::span<double> y) const;

 private:
  const DistributedMatrix& A_;
  ColumnHalo halo_;
  std::vector<int> columns_;  // as ColumnHalo::local_index gives them
  mutable std::vector<double> extended_;
};

}  // namespace seiche
