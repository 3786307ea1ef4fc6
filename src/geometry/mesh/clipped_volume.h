#pragma once
// Volume of the part of a closed surface's inside that lies in a box.
#include "geometry/mesh/mesh.h"

namespace seiche {

// Result in m^3; 2D (segments): m^2. Negative for surfaces oriented inwards.
template <int Dim>
double clipped_volume(const SurfaceMesh& surface, const Vec3& lower, const Vec3& upper);

}  // namespace seiche
