#pragma once
// A sparse approximate inverse of a symmetric positive definite matrix.
#include <vector>

#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// Factorized sparse approximate inverse (Kolotilina, Yeremin 1993): lower triangular G with the pattern of H such that
// G'G ~ H^-1 and diag(G H G') = 1. Columns that are not `wanted` are computed with but left out of the result; rows
// without wanted columns are empty.
SparseMatrix sparse_inverse_factor(const SparseMatrix& H, const std::vector<char>& wanted);

}  // namespace seiche
