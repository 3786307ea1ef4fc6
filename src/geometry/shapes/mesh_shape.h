#pragma once
// Shapes of meshes that are at hand.
#include "geometry/shapes/shapes.h"

namespace seiche {

// Signed distance from a closed mesh (2D: outline) that faces outwards. 2D: exact; 3D: sampled at cell_size (m).
template <int Dim>
std::unique_ptr<ShapeField<Dim>> make_mesh_shape(SurfaceMesh mesh, double cell_size);

}  // namespace seiche
