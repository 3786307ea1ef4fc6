#pragma once
// What measures compute on a frame of a run.
#include <string>
#include <vector>

#include "base/scene.h"
#include "levelset/openvdb_adapter.h"

namespace seiche {

// Root of the sum over the axes of mean (u_a - exact_a)^2, m/s, over the faces where `region` is negative. Throws
// Error(cannot_continue) where the frame holds no velocity or the region no face.
double velocity_difference(const vdb::Frame& frame, const VectorFormula& exact, const Formula& region);

// A velocity component along a line through `point` that is parallel to an axis.
struct LineExtreme {
  int component = 0, along = 0;
  Vec3 point{0, 0, 0};  // m; its coordinate along the line is not used
  enum class Kind { min, max } kind = Kind::min;
  double value = 0;  // m/s, expected
};

// From CSV text with the columns component, along (x, y, z), x, y, z, extreme (min, max) and value; lines that begin
// with '#' are skipped. Throws Error(cannot_continue) for a line that is none, and where there are none.
std::vector<LineExtreme> csv_lines(const std::string& text);

// The extreme, m/s: linear between the lines of faces around the point, a parabola through the three samples at the
// extreme one. Throws Error(cannot_continue) where the frame holds no velocity.
double extreme_along(const vdb::Frame& frame, const LineExtreme& line);

// The largest |phi - exact| of the cells within one cell of the surface, m. Throws Error(cannot_continue) where the
// frame holds no surface.
double surface_difference(const vdb::Frame& frame, const Formula& exact);

// Area (3D: volume) that lies inside one of the frame's surface and that of the formula and outside the other, m^Dim,
// by points a sixteenth (3D: sixth) of a cell apart. Farther than 2 cells from its zero the formula must be more than 2
// cells from zero. Throws Error(cannot_continue) where the frame holds no surface.
double surface_misplaced(const vdb::Frame& frame, const Formula& exact);

}  // namespace seiche
