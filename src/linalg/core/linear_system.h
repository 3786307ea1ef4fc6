#pragma once
// The system as every attempt of the fallback chain sees it: ghost columns are numbered, and rows with a zero diagonal
// are replaced by identity rows.
#include <cstdint>
#include <vector>

#include "linalg/core/column_halo.h"
#include "linalg/core/distributed_matrix.h"
#include "linalg/core/null_space.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

// Keeps references to `A` and `grid`.
class LinearSystem {
 public:
  // Collective.
  LinearSystem(const DistributedMatrix& A, const RowGrid& grid, const NullSpace& null_space, const Communicator& ranks);

  int rows() const { return pattern_.rows(); }
  const DistributedMatrix& pattern() const { return pattern_; }  // rows and columns; for values see values()
  const RowGrid& grid() const { return grid_; }
  const NullSpace& null_space() const { return null_space_; }
  const Communicator& ranks() const { return ranks_; }
  const ColumnHalo& halo() const { return halo_; }
  const MeanRemover& means() const { return means_; }
  // Values of A in its order, with identity rows and columns in place of those with a zero diagonal.
  const std::vector<double>& values() const { return values_; }
  double diagonal(int row) const { return values_[pattern_.row_start[row]]; }
  const std::vector<int>& identity_list() const { return identity_; }  // local rows
  std::int64_t identity_rows() const { return identity_rows_; }        // over all ranks

  // y = A x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  // r = b - A x. Collective.
  void residual(const Vector& b, const Vector& x, Vector& r) const;
  // y = |A| |x|, with the magnitudes of all entries. Collective.
  void multiply_magnitudes(const Vector& x, Vector& y) const;
  // Sets v to zero in identity rows and subtracts its mean over each component of the null space. Collective.
  void project(Vector& v) const;

 private:
  void replace_zero_diagonals();
  const double* with_ghosts(const Vector& x) const;
  double row_times(std::size_t row, const double* with_ghosts) const;

  const DistributedMatrix& pattern_;
  const RowGrid& grid_;
  NullSpace null_space_;
  Communicator ranks_;
  ColumnHalo halo_;
  std::vector<double> values_;
  std::vector<int> columns_;   // by ColumnHalo::local_index
  std::vector<int> identity_;  // local rows
  std::int64_t identity_rows_ = 0;
  MeanRemover means_;
  mutable std::vector<double> extended_;
};

}  // namespace seiche
