#pragma once
// The solid surfaces of a frame.
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::render {

// A surface piece of a solid; `solid` counts from zero in the order of the scene.
struct SolidMesh {
  SurfaceMesh mesh;
  std::vector<int> solid;  // one an element (triangle or segment)
};

}  // namespace seiche::render
