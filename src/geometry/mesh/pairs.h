#pragma once
// Pairs of edges and triangles of a surface that come close enough to meet.
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

using Edge = std::array<int, 2>;

// The edge and the triangle (indices into the lists given) of every pair without a common point that meet, and of some
// that only come close; in ascending order, each once. The cost follows the number of triangles, also where very many
// of them share a point.
std::vector<std::array<int, 2>> close_pairs(const std::vector<Vec3>& points, const std::vector<Edge>& edges,
                                            const std::vector<std::array<int, 3>>& triangles);

}  // namespace seiche::mesh
