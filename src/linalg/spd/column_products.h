#pragma once
// Products of the columns of deflation, summed over all ranks.
#include <vector>

#include <Eigen/SparseCore>

#include "base/communicator.h"
#include "linalg/core/block_columns.h"
#include "linalg/core/sparse_vector.h"

namespace seiche {

// Entries of X'Y over columns of vectors with `rows` entries on this rank. Collective.
std::vector<Eigen::Triplet<double>> products(const std::vector<SparseVector>& X, const std::vector<SparseVector>& Y,
                                             int rows, const Communicator& ranks);

// Entries of J'Z. Collective.
std::vector<Eigen::Triplet<double>> products(const BlockColumns& J, const std::vector<SparseVector>& Z, int rows,
                                             const Communicator& ranks);

}  // namespace seiche
