#pragma once
// Whether a surface of triangles crosses itself.
#include <array>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// Whether two triangles have a point in common beside the corners or the edge they share, exactly for the coordinates
// as they are. Neither may be without area.
bool intersect(const SurfaceMesh& mesh, const std::array<int, 3>& s, const std::array<int, 3>& t);

// Pairs of triangles that intersect, lower index first, in ascending order. Triangles without area count for nothing,
// and their neighbours may touch along them.
std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh);

}  // namespace seiche::mesh
