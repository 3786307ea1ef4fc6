#pragma once
// What measures compute on a frame's velocity along lines parallel to an axis.
#include <string>
#include <vector>

#include "base/vec.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {

// A velocity component along a line through `point`.
struct LineExtreme {
  int component = 0, along = 0;
  Vec3 point{0, 0, 0};  // m; its coordinate along the line is not used
  enum class Kind { min, max } kind = Kind::min;
  double value = 0;  // expected: m/s, or where it is, m
};

// From CSV text with the columns component, along (x, y, z), x, y, z, extreme (min, max) and value; lines that begin
// with '#' are skipped. Throws Error(cannot_continue) for a line that is none, and where there are none.
std::vector<LineExtreme> csv_extremes(const std::string& text);

struct FoundExtreme {
  double value = 0;  // m/s
  double place = 0;  // m, along the line
};

// The extreme: linear between the lines of faces around the point, a parabola through the three samples at the extreme
// one. Throws Error(cannot_continue) where the frame holds no velocity.
FoundExtreme extreme_along(const vdb::Frame& frame, const LineExtreme& line);

// A velocity component at a point of such a line.
struct LinePoint {
  int component = 0, along = 0;
  Vec3 point{0, 0, 0};  // m
  double value = 0;     // m/s, expected
};

// From CSV text with the columns component, along (x, y, z), x, y, z and value. Throws as csv_extremes().
std::vector<LinePoint> csv_profile(const std::string& text);

// The component there, m/s: linear between the lines of faces around the point, a cubic through the four samples around
// it on them. Throws Error(cannot_continue) where the frame holds no velocity, and for a point beyond the samples or
// the domain, or a line of less than four.
double value_along(const vdb::Frame& frame, const LinePoint& at);

// The largest magnitude of the stream function of a 2D frame in a domain full of liquid, m^2/s, with its sign: u summed
// up from the lower wall, where it is zero, to the corners of the cells; a parabola either way through the three
// corners at the extreme one. Throws Error(cannot_continue) for 3D frames and where the frame holds no velocity.
double stream_function_extreme(const vdb::Frame& frame);

}  // namespace seiche
