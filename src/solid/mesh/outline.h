#pragma once
// Closed outlines of 2D bodies cut into pieces of a wanted length.
#include "geometry/mesh/mesh.h"

namespace seiche {

// The outline with points at its corners and evenly between them along it, at most `size` (m) apart. A corner is where
// it turns by more than 40 degrees within size / 2. Closed loops of segments stay closed.
SurfaceMesh resample_outline(const SurfaceMesh& outline, double size);

}  // namespace seiche
