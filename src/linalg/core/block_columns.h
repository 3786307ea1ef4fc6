#pragma once
// Tall sparse matrices in blocks of columns that each touch few rows: the coupling of bodies to the liquid.
#include <vector>

#include <Eigen/Core>

#include "base/communicator.h"
#include "linalg/core/sparse_cholesky.h"
#include "linalg/core/vector_ops.h"

namespace seiche {

// This rank's rows of `width` columns. Row row[i] holds entries start[i] up to start[i + 1]; rows ascend.
struct ColumnBlock {
  int width = 0;
  std::vector<int> row;
  std::vector<int> start{0};
  std::vector<int> column;  // of each entry, within the block
  std::vector<double> value;
  // Loads f, one a column (width rows). Preconditioners treat the responses H^-1 f exactly. For a deformable body:
  // weights of its nodes whose sums are forces and moments. Empty: a rigid body, each of whose columns is treated
  // exactly.
  Eigen::MatrixXd loads;

  // The entries of a row must be added one after the other.
  void add(int in_row, int in_column, double entry);
  bool deforms() const { return loads.size() > 0; }
  // Calls f(row, column, value).
  template <class Visit>
  void for_each(const Visit& f) const {
    for (std::size_t i = 0; i < row.size(); ++i)
      for (int n = start[i]; n < start[i + 1]; ++n) f(row[i], column[std::size_t(n)], value[std::size_t(n)]);
  }
};

struct BlockColumns {
  std::vector<ColumnBlock> blocks;
  // C of constraints C v = b on the bodies' unknowns, as of joints; no rows: none. Same on all ranks.
  SparseMatrix constraints{};
  int columns() const;
  bool any_deforms() const;
  // First column of each block, and the number of columns.
  std::vector<int> first_columns() const;
  // Calls f(row, column, value) with the column counted over all blocks.
  template <class Visit>
  void for_each(const Visit& f) const {
    int first = 0;
    for (const ColumnBlock& b : blocks) {
      b.for_each([&](int i, int k, double value) { f(i, first + k, value); });
      first += b.width;
    }
  }
};

// y += J v, v the same on all ranks.
void add_multiplied(const BlockColumns& J, const Eigen::VectorXd& v, Vector& y);

// This rank's part of J' x.
Eigen::VectorXd local_transposed(const BlockColumns& J, const Vector& x);

// J' x, the same on all ranks. Collective.
Eigen::VectorXd multiply_transposed(const BlockColumns& J, const Vector& x, const Communicator& ranks);

// Copies the bits of rank 0 to all ranks. Collective.
void make_identical(Eigen::VectorXd& v, const Communicator& ranks);

}  // namespace seiche
