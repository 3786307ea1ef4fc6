#pragma once
// Elimination of a small system gathered on one rank: the last rung.
#include <string>

#include "linalg/spd/coupled_system.h"

namespace seiche {

inline constexpr std::int64_t direct_solve_limit = 20000;  // rows

// Solves S x = b, b compatible. In each component of the null space of A the first row is grounded (x = 0 there), and
// where bodies are coupled in, [[A, J], [J', -H/c]] is eliminated. Returns why it failed, or an empty text; the same on
// all ranks. Collective.
std::string solve_directly(const CoupledSystem& system, const Vector& b, Vector& x);

}  // namespace seiche
