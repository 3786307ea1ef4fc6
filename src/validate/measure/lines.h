#pragma once
// Measures of a frame's velocity along lines parallel to an axis.
#include <string>
#include <vector>

#include "base/vec.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

// Extreme of a velocity component along a line through `point`.
struct LineExtreme {
  int component = 0, along = 0;
  Vec3 point{0, 0, 0};  // m; the coordinate along the line is unused
  enum class Kind { min, max } kind = Kind::min;
  double value = 0;  // expected: value (m/s) or position (m)
};

// Reads CSV text with the columns component, along (x, y, z), x, y, z, extreme (min, max) and value; skips lines that
// begin with '#'. Throws Error(cannot_continue) for invalid lines, and if there are none.
std::vector<LineExtreme> csv_extremes(const std::string& text);

struct FoundExtreme {
  double value = 0;  // m/s
  double place = 0;  // m, along the line
};

// Finds the extreme: linear between the lines of faces around the point, with a parabola through the three samples
// around the extreme one. Throws Error(cannot_continue) if the frame has no velocity.
FoundExtreme extreme_along(const vdb::Frame& frame, const LineExtreme& line);

// Velocity component at a point of such a line.
struct LinePoint {
  int component = 0, along = 0;
  Vec3 point{0, 0, 0};  // m
  double value = 0;     // expected, m/s
};

// Reads CSV text with the columns component, along (x, y, z), x, y, z and value. Throws as csv_extremes().
std::vector<LinePoint> csv_profile(const std::string& text);

// The component at that point, m/s: linear between the lines of faces around it, with a cubic through the four samples
// around it on these lines. Throws Error(cannot_continue) if the frame has no velocity, for points outside of samples
// or domain, and for lines of less than four samples.
double value_along(const vdb::Frame& frame, const LinePoint& at);

// Value of largest magnitude, with its sign, of the stream function of a 2D frame with the domain full of liquid,
// m^2/s. u is summed from the lower wall, where the function is zero, to the cell corners; a parabola in each direction
// goes through the three corners at the extreme one. Throws Error(cannot_continue) for 3D frames and if the frame has
// no velocity.
double stream_function_extreme(const vdb::Frame& frame);

}  // namespace seiche
