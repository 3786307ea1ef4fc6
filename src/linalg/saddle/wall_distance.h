#pragma once
// How far faces are from walls, as their equations know it.
#include "linalg/core/linear_system.h"

namespace seiche {

// By row of F: 1 where links to walls are a part of its viscous diagonal, one more with each row along the same axis of
// velocity (`axis`; empty: one); `most` beyond. `mass` is the part of F that is no viscosity. Collective.
std::vector<int> rows_from_walls(const LinearSystem& F, const std::vector<int>& axis, const Vector& mass, int most);

}  // namespace seiche
