#pragma once
// Surfaces of the solids in a frame.
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::render {

// Surface mesh with the solid of each element; `solid` counts from zero in the order of the scene.
struct SolidMesh {
  SurfaceMesh mesh;
  std::vector<int> solid;  // one an element (triangle or segment)
};

}  // namespace seiche::render
