#pragma once
// Inside test for closed surfaces of triangles.
#include "geometry/mesh/distance.h"

namespace seiche::mesh {

// True if x lies inside: a ray from it crosses the surface an odd number of times. The test is exact for the stored
// coordinates, including rays through corners and along edges. On the surface the result is arbitrary.
bool contains(const NearestTriangle& surface, const Vec3& x);

}  // namespace seiche::mesh
