#pragma once
// Direct solution of a small system gathered on one rank: the last attempt of the fallback chain.
#include <string>

#include "linalg/spd/coupled_system.h"

namespace seiche {

inline constexpr std::int64_t direct_solve_limit = 20000;  // rows

// Solves S x = b, b compatible. In each component of the null space of A the first row is grounded (x = 0 there). If
// bodies are coupled, [[A, J], [J', -H/c]] is factored, bordered by their constraints. Returns the reason of a failure
// or an empty string; the same on all ranks. Collective.
std::string solve_directly(const CoupledSystem& system, const Vector& b, Vector& x);

}  // namespace seiche
