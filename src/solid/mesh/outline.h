#pragma once
// Resamples closed outlines of 2D bodies.
#include "geometry/mesh/mesh.h"

namespace seiche {

// Outline with points at its corners and evenly along it between them, at most `size` (m) apart. A corner turns by more
// than 40 degrees within size / 2. Closed loops of segments stay closed.
SurfaceMesh resample_outline(const SurfaceMesh& outline, double size);

}  // namespace seiche
