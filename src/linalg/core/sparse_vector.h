#pragma once
// Vectors over this rank's rows with few nonzero entries.
#include "linalg/core/vector_ops.h"

namespace seiche {

// `row` ascends.
struct SparseVector {
  std::vector<int> row;
  std::vector<double> value;
};

SparseVector nonzeros(const Vector& x);

// Dot product over this rank's entries.
double local_dot(const SparseVector& x, const Vector& y);

// y += a x
void add_scaled(Vector& y, double a, const SparseVector& x);

// y -= sum of q_c x_c
void subtract_combination(const std::vector<SparseVector>& columns, std::span<const double> q, Vector& y);

}  // namespace seiche
