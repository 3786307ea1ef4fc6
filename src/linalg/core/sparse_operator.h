#pragma once
// Products with a rectangular distributed matrix.
#include "linalg/core/column_halo.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

// Keeps a reference to the matrix.
class SparseOperator {
 public:
  // Columns refer to a vector of which this rank owns `owned` entries, numbered from `first`. Collective.
  SparseOperator(const DistributedMatrix& A, Row first, int owned, const Communicator& ranks);

  int rows() const { return A_.rows(); }
  int owned_columns() const { return halo_.owned(); }
  // y += A x; y has at least rows() entries, x has owned_columns(). Collective.
  void add_multiplied(std::span<const double> x, std::span<double> y) const;

 private:
  const DistributedMatrix& A_;
  ColumnHalo halo_;
  std::vector<int> columns_;  // by ColumnHalo::local_index
  mutable std::vector<double> extended_;
};

}  // namespace seiche
