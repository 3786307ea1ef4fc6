#pragma once
// What measures compute on the outline of a frame's surface.
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

// Circumference of the circle of the area that the surface encloses, liquid or gas, over the surface's length, of a 2D
// frame: 1 for a circle, less for all else; of several pieces that of all together. Segments between the sides of
// triangles half a cell wide: second order, 1e-4 low where a cell is a twentieth of the radius. Throws
// Error(cannot_continue) where the frame has none, where it meets the domain's sides, and in 3D.
double circularity(const vdb::Frame& frame);

}  // namespace seiche
