#pragma once
// Distributed vectors: each rank holds the entries of its own rows. The order of every sum is fixed, so that the same
// run at the same rank count gives the same bits.
#include <cmath>
#include <span>
#include <vector>

#include "base/communicator.h"

namespace seiche {

using Vector = std::vector<double>;

// Sum over the ranks of x_i y_i. Collective.
double dot(const Vector& x, const Vector& y, const Communicator& ranks);

// The 2-norm over the ranks. Collective.
double norm(const Vector& x, const Communicator& ranks);

// y += a x
void add_scaled(Vector& y, double a, const Vector& x);

// y = x + a y
void scale_and_add(Vector& y, double a, const Vector& x);

// Whether no entry on any rank is infinite or NaN. Collective.
bool all_finite(std::span<const double> x, const Communicator& ranks);

}  // namespace seiche
