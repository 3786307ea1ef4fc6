#pragma once
// Elimination of a small system gathered on one rank: the last rung.
#include <string>

#include "linalg/linear_system.h"

namespace seiche {

inline constexpr std::int64_t direct_solve_limit = 20000;  // rows

// Solves A x = b, b compatible. In each component of the null space the first row is grounded (x = 0 there). Returns
// why it failed, or an empty text; the same on all ranks. Collective.
std::string solve_directly(const LinearSystem& system, const Vector& b, Vector& x);

}  // namespace seiche
