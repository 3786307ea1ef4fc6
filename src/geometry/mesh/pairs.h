#pragma once
// Pairs of edges and triangles of a surface that are close enough to meet.
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

using Edge = std::array<int, 2>;

// Pairs (edge, triangle) of indices into the lists, in ascending order, each once. Contains all pairs without a common
// point that meet, and some that are only close. The cost grows with the number of triangles, even if very many of them
// share a point.
std::vector<std::array<int, 2>> close_pairs(const std::vector<Vec3>& points, const std::vector<Edge>& edges,
                                            const std::vector<std::array<int, 3>>& triangles);

}  // namespace seiche::mesh
