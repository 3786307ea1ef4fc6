#pragma once
// Measures of a frame of a run.
#include <string>
#include <vector>

#include "base/formula.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

// Velocity of the frame. Throws Error(cannot_continue) if it has none.
const vdb::Grid& velocity_of(const vdb::Frame& frame);

// L2 norm: root of the sum over the axes of mean (u_a - exact_a)^2, m/s, over the faces where `region` is negative.
// Throws Error(cannot_continue) if the frame has no velocity or the region no face.
double velocity_difference(const vdb::Frame& frame, const VectorFormula& exact, const Formula& region);

// Largest |u_a - exact_a| of any axis over these faces, m/s. Throws as velocity_difference().
double largest_velocity_difference(const vdb::Frame& frame, const VectorFormula& exact, const Formula& region);

// Largest |phi - exact| of the cells within one cell of the surface, m. Throws Error(cannot_continue) if the frame has
// no surface.
double surface_difference(const vdb::Frame& frame, const Formula& exact);

// Area (3D: volume) between the frame's surface and that of the formula, m^Dim: inside exactly one of them. Sampled at
// points a sixteenth (3D: sixth) of a cell apart. |formula| must exceed 2 cells where it is more than 2 cells from
// its zero. Throws Error(cannot_continue) if the frame has no surface.
double surface_misplaced(const vdb::Frame& frame, const Formula& exact);

}  // namespace seiche
