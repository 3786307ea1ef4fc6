#pragma once
// Tall matrices with few columns, in blocks that each touch few rows: how bodies, six numbers each, act on the liquid.
#include <vector>

#include <Eigen/Core>

#include "base/communicator.h"
#include "linalg/vector_ops.h"

namespace seiche {

// This rank's rows of `width` columns; value[i * width + k] stands in row[i], column k of the block. Rows ascend.
struct ColumnBlock {
  int width = 0;
  std::vector<int> row;
  std::vector<double> value;
};

struct BlockColumns {
  std::vector<ColumnBlock> blocks;
  int columns() const;
  // First column of each block, and the number of columns.
  std::vector<int> first_columns() const;
};

// y += J v, v the same on all ranks.
void add_multiplied(const BlockColumns& J, const Eigen::VectorXd& v, Vector& y);

// J' x of this rank's rows.
Eigen::VectorXd local_transposed(const BlockColumns& J, const Vector& x);

// J' x, the same on all ranks. Collective.
Eigen::VectorXd multiply_transposed(const BlockColumns& J, const Vector& x, const Communicator& ranks);

// The same bits on all ranks: those of rank 0. Collective.
void make_identical(Eigen::VectorXd& v, const Communicator& ranks);

}  // namespace seiche
