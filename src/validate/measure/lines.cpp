#include "validate/measure/lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "scene/formula.h"
#include "validate/measure/frames.h"
#include "validate/measure/measures.h"

namespace seiche {
namespace {

// Velocity of a frame, as one block.
class Velocity {
 public:
  explicit Velocity(const vdb::Frame& frame) : frame_(frame) {
    const vdb::Grid& grid = velocity_of(frame);
    if (grid.blocks.size() != 1) throw Error(ExitCode::cannot_continue, "the last frame holds no velocity");
    block_ = &grid.blocks[0];
  }
  int size(int axis) const { return block_->upper[axis] - block_->lower[axis]; }

  // Component a at a position in units of its faces; linear between them, constant outside of the last ones.
  double at(int a, const Vec3& where) const {
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<int, 3> i{};
      for (int axis = 0; axis < 3; ++axis) {
        const double x = std::clamp(where[axis], 0.0, double(size(axis) - 1)), low = std::floor(x);
        const bool high = (corner >> axis) & 1;
        weight *= high ? x - low : 1 - (x - low);
        i[axis] = std::min(int(low) + int(high), size(axis) - 1);
      }
      sum += weight * value(a, i);
    }
    return sum;
  }

  // True if a point (m) lies in the domain, with a tolerance for rounding.
  bool covers(const Vec3& x) const {
    for (int axis = 0; axis < frame_.dimension; ++axis) {
      const double place = (x[axis] - frame_.lower[axis]) / frame_.cell_size;
      if (place < -1e-9 || place > size(axis) + 1e-9) return false;
    }
    return true;
  }

  // Position of a point (m) in units of faces; the third axis of 2D frames has no extent.
  Vec3 face_index(int a, const Vec3& x) const {
    Vec3 index = (x - frame_.lower) / frame_.cell_size - Vec3::Constant(0.5);
    index[a] += 0.5;
    if (frame_.dimension == 2) index[2] = 0;
    return index;
  }

 private:
  double value(int a, const std::array<int, 3>& i) const {
    const auto n = std::size_t(i[0]) + std::size_t(size(0)) * (std::size_t(i[1]) + std::size_t(size(1)) * i[2]);
    return block_->values[3 * n + std::size_t(a)];
  }

  const vdb::Frame& frame_;
  const vdb::Block* block_;
};

// Extreme of the parabola through three samples a step apart, the middle one being the largest or smallest. way: its
// offset from the middle sample in steps; rise: its value above that of the middle sample.
struct Vertex {
  double way = 0, rise = 0;
};

Vertex vertex_of(double before, double middle, double after) {
  const double bend = after - 2 * middle + before, slope = 0.5 * (after - before);
  return bend == 0 ? Vertex{} : Vertex{-slope / bend, -0.5 * slope * slope / bend};
}

int axis_of(const std::string& name) {
  const std::size_t axis = std::string("xyz").find(name);
  if (name.size() != 1 || axis == std::string::npos)
    throw Error(ExitCode::cannot_continue, "'" + name + "' is no axis: x, y or z");
  return int(axis);
}

double number_of(const std::string& text) {
  const auto number = plain_number(text);
  if (!number) throw Error(ExitCode::cannot_continue, "'" + text + "' is no number");
  return *number;
}

// Columns: component, along, x, y, z.
template <class Line>
Line read_place(const std::vector<std::string>& fields, std::size_t columns) {
  if (fields.size() != columns)
    throw Error(ExitCode::cannot_continue,
                fmt::format("a row of a line needs {} columns: {}", columns, fmt::join(fields, ",")));
  Line line;
  line.component = axis_of(fields[0]);
  line.along = axis_of(fields[1]);
  for (int a = 0; a < 3; ++a) line.point[a] = number_of(fields[std::size_t(2 + a)]);
  line.value = number_of(fields.back());
  return line;
}

LineExtreme read_extreme(const std::vector<std::string>& fields) {
  auto line = read_place<LineExtreme>(fields, 7);
  if (fields[5] != "min" && fields[5] != "max")
    throw Error(ExitCode::cannot_continue, "'" + fields[5] + "' is no extreme: min or max");
  line.kind = fields[5] == "min" ? LineExtreme::Kind::min : LineExtreme::Kind::max;
  return line;
}

LinePoint read_point(const std::vector<std::string>& fields) {
  return read_place<LinePoint>(fields, 6);
}

// Calls read(fields) for the rows below this header.
template <class Read>
auto read_rows(const std::string& text, const std::string& header, const Read& read) {
  const auto rows = csv_rows(text);
  if (!rows.empty() && fmt::format("{}", fmt::join(rows[0], ",")) != header)
    throw Error(ExitCode::cannot_continue, fmt::format("the first row is to be {}", header));
  if (rows.size() < 2) throw Error(ExitCode::cannot_continue, "there are no rows to compare with");
  std::vector<decltype(read(rows[0]))> found;
  for (std::size_t n = 1; n < rows.size(); ++n) found.push_back(read(rows[n]));
  return found;
}

// Value at x of the cubic through values at -1, 0, 1 and 2.
double cubic_between(const std::array<double, 4>& f, double x) {
  return -f[0] * x * (x - 1) * (x - 2) / 6 + f[1] * (x + 1) * (x - 1) * (x - 2) / 2 - f[2] * (x + 1) * x * (x - 2) / 2 +
         f[3] * (x + 1) * x * (x - 1) / 6;
}

}  // namespace

std::vector<LineExtreme> csv_extremes(const std::string& text) {
  return read_rows(text, "component,along,x,y,z,extreme,value", read_extreme);
}

std::vector<LinePoint> csv_profile(const std::string& text) {
  return read_rows(text, "component,along,x,y,z,value", read_point);
}

FoundExtreme extreme_along(const vdb::Frame& frame, const LineExtreme& line) {
  const Velocity u(frame);
  const double sign = line.kind == LineExtreme::Kind::max ? 1 : -1;
  const int last = u.size(line.along) - 1;
  Vec3 where = u.face_index(line.component, line.point);
  const auto sample = [&](int n) {
    where[line.along] = n;
    return u.at(line.component, where);
  };
  int most = 0;
  for (int n = 1; n <= last; ++n)
    if (sign * sample(n) > sign * sample(most)) most = n;
  const bool inside = most > 0 && most < last;
  const Vertex vertex = inside ? vertex_of(sample(most - 1), sample(most), sample(most + 1)) : Vertex{};
  const double shift = line.component == line.along ? 0 : 0.5;  // of the first sample from the domain's end, in cells
  return {sample(most) + vertex.rise, frame.lower[line.along] + frame.cell_size * (most + shift + vertex.way)};
}

double value_along(const vdb::Frame& frame, const LinePoint& at) {
  const Velocity u(frame);
  const int last = u.size(at.along) - 1;
  Vec3 where = u.face_index(at.component, at.point);
  const double place = where[at.along];
  // Rounding may move a point on the last sample beyond it.
  if (last < 3 || place < -1e-9 || place > last + 1e-9 || !u.covers(at.point))
    throw Error(ExitCode::cannot_continue,
                fmt::format("no samples around ({:g}, {:g}, {:g}) on the line", at.point[0], at.point[1], at.point[2]));
  const int low = std::clamp(int(std::floor(place)), 1, last - 2);
  std::array<double, 4> samples{};
  for (int n = 0; n < 4; ++n) {
    where[at.along] = low - 1 + n;
    samples[std::size_t(n)] = u.at(at.component, where);
  }
  return cubic_between(samples, place - low);
}

double stream_function_extreme(const vdb::Frame& frame) {
  if (frame.dimension != 2) throw Error(ExitCode::cannot_continue, "a stream function is of a 2D run");
  const Velocity u(frame);
  const int nx = u.size(0), ny = u.size(1);
  std::vector<double> psi(std::size_t(nx) * std::size_t(ny + 1), 0);  // at corner (i, j), i below nx
  const auto at = [&](int i, int j) -> double& { return psi[std::size_t(i) + std::size_t(nx) * std::size_t(j)]; };
  int x = 0, y = 0;
  for (int j = 1; j <= ny; ++j)
    for (int i = 0; i < nx; ++i) {
      at(i, j) = at(i, j - 1) + frame.cell_size * u.at(0, Vec3(i, j - 1, 0));
      if (std::abs(at(i, j)) > std::abs(at(x, y))) x = i, y = j;
    }
  double extreme = at(x, y);
  if (x > 0 && x < nx - 1) extreme += vertex_of(at(x - 1, y), at(x, y), at(x + 1, y)).rise;
  if (y > 0 && y < ny) extreme += vertex_of(at(x, y - 1), at(x, y), at(x, y + 1)).rise;
  return extreme;
}

}  // namespace seiche
