#pragma once
// Whether points lie inside of a closed surface of triangles.
#include "geometry/mesh/distance.h"

namespace seiche::mesh {

// Whether x lies inside: whether a ray from it crosses the surface an odd number of times. Decided exactly for the
// coordinates as they are, so rays through corners and along edges count right; on the surface either answer may come.
bool contains(const NearestTriangle& surface, const Vec3& x);

}  // namespace seiche::mesh
