#pragma once
// Distributed vectors: each rank holds the entries of its own rows. Every sum has a fixed order, so that runs on the
// same number of ranks give the same bits on any number of threads.
#include <cmath>
#include <span>
#include <vector>

#include "base/communicator.h"

namespace seiche {

using Vector = std::vector<double>;

// Entries that a thread takes at a time.
constexpr std::size_t entries_a_task = 4096;

// Sum of x_i y_i over this rank's entries.
double local_dot(const Vector& x, const Vector& y);

// Sum of x_i y_i over all ranks. Collective.
double dot(const Vector& x, const Vector& y, const Communicator& ranks);

// 2-norm over all ranks. Collective.
double norm(const Vector& x, const Communicator& ranks);

// y += a x
void add_scaled(Vector& y, double a, const Vector& x);

// y = x + a y
void scale_and_add(Vector& y, double a, const Vector& x);

// True if every entry on every rank is finite. Collective.
bool all_finite(std::span<const double> x, const Communicator& ranks);

}  // namespace seiche
