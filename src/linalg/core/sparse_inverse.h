#pragma once
// A sparse approximate inverse of a symmetric positive definite matrix.
#include <vector>

#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// G, lower triangular with the pattern of H there, such that G'G approximates H^-1 and diag(G H G') = 1 (Kolotilina,
// Yeremin 1993). Columns that are not `wanted` are left out of the result, not of what it is made from.
SparseMatrix sparse_inverse_factor(const SparseMatrix& H, const std::vector<char>& wanted);

}  // namespace seiche
