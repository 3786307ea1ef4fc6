#pragma once
// Measures of the outline of a frame's surface.
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

// Circularity of a 2D frame: the circumference of the circle with the enclosed area (liquid or gas) over the length of
// the surface. 1 for a circle, less for other shapes; pieces are added up. Second order, from segments on triangles
// half a cell wide: 1e-4 low for a radius of 20 cells. Throws Error(cannot_continue) for frames without surface,
// surfaces that meet the domain's sides, and 3D.
double circularity(const vdb::Frame& frame);

}  // namespace seiche
