#pragma once
// The surface of the liquid in a frame as a closed mesh.
#include "geometry/mesh/writers.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche::exporting {

struct AttributedMesh {
  SurfaceMesh mesh;
  std::vector<mesh::PointAttribute> attributes;
};

// The zero contour of the frame's `surface`, closed at the sides of the domain; triangles face out of the liquid.
// Attributes: `velocity` (m/s) and each scalar field of the frame, interpolated from within the liquid. 3D. Throws
// Error(bad_input) if the frame has no surface.
AttributedMesh liquid_mesh(const vdb::Frame& frame);

}  // namespace seiche::exporting
