#pragma once
// Self-intersections of surfaces of triangles.
#include <array>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// True if two triangles have a common point other than their shared corners or edge. Exact for the stored coordinates.
// Both must have an area.
bool intersect(const SurfaceMesh& mesh, const std::array<int, 3>& s, const std::array<int, 3>& t);

// Pairs of triangles that intersect, lower index first, in ascending order. Triangles without area are ignored, and
// their neighbours may touch along them.
std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh);

}  // namespace seiche::mesh
