#pragma once
// The facets of a surface in either dimension.
#include "geometry/mesh/mesh.h"

namespace seiche {

// Segments (2D) or triangles (3D) of Dim points each.
template <int Dim>
const std::vector<std::array<int, Dim>>& facets_of(const SurfaceMesh& mesh) {
  if constexpr (Dim == 2)
    return mesh.segments;
  else
    return mesh.triangles;
}

}  // namespace seiche
