#pragma once
// Distance of faces from walls, found from the matrix.
#include "linalg/core/linear_system.h"

namespace seiche {

// Distance per row of F: 1 if links to walls contribute to its viscous diagonal, then one more per neighbouring row of
// the same velocity axis; at most `most`. `axis` may be empty (one axis). `mass` is the part of F without viscosity.
// Collective.
std::vector<int> rows_from_walls(const LinearSystem& F, const std::vector<int>& axis, const Vector& mass, int most);

}  // namespace seiche
