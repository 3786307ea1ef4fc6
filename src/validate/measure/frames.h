#pragma once
// What measures compute on a frame of a run.
#include <string>
#include <vector>

#include "base/scene.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

// The frame's velocity. Throws Error(cannot_continue) where it holds none.
const vdb::Grid& velocity_of(const vdb::Frame& frame);

// Root of the sum over the axes of mean (u_a - exact_a)^2, m/s, over the faces where `region` is negative. Throws
// Error(cannot_continue) where the frame holds no velocity or the region no face.
double velocity_difference(const vdb::Frame& frame, const VectorFormula& exact, const Formula& region);

// The largest |u_a - exact_a| of any axis over these faces, m/s. Throws as velocity_difference().
double largest_velocity_difference(const vdb::Frame& frame, const VectorFormula& exact, const Formula& region);

// The largest |phi - exact| of the cells within one cell of the surface, m. Throws Error(cannot_continue) where the
// frame holds no surface.
double surface_difference(const vdb::Frame& frame, const Formula& exact);

// Area (3D: volume) that lies inside one of the frame's surface and that of the formula and outside the other, m^Dim,
// by points a sixteenth (3D: sixth) of a cell apart. Farther than 2 cells from its zero the formula must be more than 2
// cells from zero. Throws Error(cannot_continue) where the frame holds no surface.
double surface_misplaced(const vdb::Frame& frame, const Formula& exact);

}  // namespace seiche
