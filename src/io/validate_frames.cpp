#include "io/validate_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/expression.h"
#include "io/scene_formula.h"
#include "io/validate_measures.h"

namespace seiche {
namespace {

const vdb::Grid& grid_of(const vdb::Frame& frame, const std::string& name, const std::string& what) {
  const auto found =
      std::find_if(frame.grids.begin(), frame.grids.end(), [&](const vdb::Grid& grid) { return grid.name == name; });
  if (found == frame.grids.end()) throw Error(ExitCode::cannot_continue, "the last frame holds no " + what);
  return *found;
}

const vdb::Grid& velocity_of(const vdb::Frame& frame) {
  return grid_of(frame, "vel", "velocity");
}

// visit(index, values) of every voxel.
template <class Visit>
void for_each_voxel(const vdb::Block& block, int components, const Visit& visit) {
  const float* value = block.values.data();
  for (int k = block.lower[2]; k < block.upper[2]; ++k)
    for (int j = block.lower[1]; j < block.upper[1]; ++j)
      for (int i = block.lower[0]; i < block.upper[0]; ++i, value += components) visit(Vec3(i, j, k), value);
}

Vec3 cell_center(const vdb::Frame& frame, const Vec3& index) {
  return frame.lower + frame.cell_size * (index + Vec3::Constant(0.5));
}

// The frame's velocity as one block.
class Velocity {
 public:
  explicit Velocity(const vdb::Frame& frame) : frame_(frame) {
    const vdb::Grid& grid = velocity_of(frame);
    if (grid.blocks.size() != 1) throw Error(ExitCode::cannot_continue, "the last frame holds no velocity");
    block_ = &grid.blocks[0];
  }
  int size(int axis) const { return block_->upper[axis] - block_->lower[axis]; }

  // Component a at a position in units of faces of that component, linear between them and constant beyond the last.
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

  // Of a point, m; the third axis of 2D frames has no extent.
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

// The extreme of the parabola through three samples a step apart, the middle one the largest or smallest.
double parabola_extreme(double before, double middle, double after) {
  const double bend = after - 2 * middle + before, slope = 0.5 * (after - before);
  return bend == 0 ? middle : middle - 0.5 * slope * slope / bend;
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

LineExtreme read_line(const std::vector<std::string>& fields) {
  if (fields.size() != 7) throw Error(ExitCode::cannot_continue, "a line of extremes needs seven columns");
  LineExtreme line;
  line.component = axis_of(fields[0]);
  line.along = axis_of(fields[1]);
  for (int a = 0; a < 3; ++a) line.point[a] = number_of(fields[std::size_t(2 + a)]);
  if (fields[5] != "min" && fields[5] != "max")
    throw Error(ExitCode::cannot_continue, "'" + fields[5] + "' is no extreme: min or max");
  line.kind = fields[5] == "min" ? LineExtreme::Kind::min : LineExtreme::Kind::max;
  line.value = number_of(fields[6]);
  return line;
}

std::vector<std::string> fields_of(const std::string& row) {
  std::vector<std::string> fields;
  std::istringstream in(row);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

// A level set between its cell centres: linear, constant beyond the outermost.
class SurfaceSamples {
 public:
  explicit SurfaceSamples(const vdb::Frame& frame) : frame_(frame) {
    const vdb::Grid& grid = grid_of(frame, "surface", "surface");
    if (grid.blocks.size() != 1) throw Error(ExitCode::cannot_continue, "the last frame holds no surface");
    block_ = &grid.blocks[0];
  }
  const vdb::Block& block() const { return *block_; }

  double operator()(const Vec3& x) const {
    const Vec3 where = (x - frame_.lower) / frame_.cell_size - Vec3::Constant(0.5);
    std::array<int, 3> low{}, high{};
    Vec3 part = Vec3::Zero();
    for (int a = 0; a < frame_.dimension; ++a) {
      const int last = block_->upper[a] - block_->lower[a] - 1;
      const double at = std::clamp(where[a], 0.0, double(last));
      low[a] = int(std::floor(at));
      high[a] = std::min(low[a] + 1, last);
      part[a] = at - low[a];
    }
    double sum = 0;
    for (int corner = 0; corner < (1 << frame_.dimension); ++corner) {
      std::array<int, 3> i = low;
      double weight = 1;
      for (int a = 0; a < frame_.dimension; ++a) {
        const bool up = (corner >> a) & 1;
        weight *= up ? part[a] : 1 - part[a];
        if (up) i[a] = high[a];
      }
      sum += weight * value(i);
    }
    return sum;
  }

 private:
  double value(const std::array<int, 3>& i) const {
    const auto size = [&](int a) { return std::size_t(block_->upper[a] - block_->lower[a]); };
    return block_->values[std::size_t(i[0]) + size(0) * (std::size_t(i[1]) + size(1) * std::size_t(i[2]))];
  }

  const vdb::Frame& frame_;
  const vdb::Block* block_;
};

// Share of the cell around `center` in which one of the two is negative and the other is not, by n^Dim points.
template <class Field>
double share_between(const vdb::Frame& frame, const Vec3& center, int n, const Field& phi, const Expression& exact) {
  const int points = int(std::pow(n, frame.dimension) + 0.5);
  int differ = 0;
  for (int k = 0; k < points; ++k) {
    Vec3 x = center;
    for (int a = 0, rest = k; a < frame.dimension; ++a, rest /= n)
      x[a] += frame.cell_size * ((rest % n + 0.5) / n - 0.5);
    differ += (phi(x) < 0) != (exact(x, frame.time) < 0);
  }
  return double(differ) / points;
}

}  // namespace

double velocity_difference(const vdb::Frame& frame, const VectorFormula& formula, const Formula& region) {
  const VectorExpression exact(formula);
  const Expression inside(region);
  Vec3 sums = Vec3::Zero(), counts = Vec3::Zero();
  for (const vdb::Block& block : velocity_of(frame).blocks)
    for_each_voxel(block, 3, [&](const Vec3& index, const float* u) {
      for (int axis = 0; axis < frame.dimension; ++axis) {
        Vec3 x = cell_center(frame, index);
        x[axis] -= 0.5 * frame.cell_size;
        if (!(inside(x, frame.time) < 0)) continue;
        const double difference = u[axis] - exact.component(axis, x, frame.time);
        sums[axis] += difference * difference;
        counts[axis] += 1;
      }
    });
  double mean = 0;
  for (int axis = 0; axis < frame.dimension; ++axis) {
    if (counts[axis] == 0) throw Error(ExitCode::cannot_continue, "no face lies in the region");
    mean += sums[axis] / counts[axis];
  }
  return std::sqrt(mean);
}

std::vector<LineExtreme> csv_lines(const std::string& text) {
  std::vector<LineExtreme> lines;
  std::istringstream in(text);
  bool header = true;
  for (std::string row; std::getline(in, row);) {
    if (row.empty() || row[0] == '#') continue;
    if (!header) lines.push_back(read_line(fields_of(row)));
    header = false;
  }
  if (lines.empty()) throw Error(ExitCode::cannot_continue, "there are no extremes to compare with");
  return lines;
}

double extreme_along(const vdb::Frame& frame, const LineExtreme& line) {
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
  if (most == 0 || most == last) return sample(most);
  return parabola_extreme(sample(most - 1), sample(most), sample(most + 1));
}

double surface_difference(const vdb::Frame& frame, const Formula& formula) {
  const Expression exact(formula);
  double most = 0;
  bool any = false;
  for (const vdb::Block& block : grid_of(frame, "surface", "surface").blocks)
    for_each_voxel(block, 1, [&](const Vec3& index, const float* phi) {
      if (!(std::abs(*phi) < frame.cell_size)) return;
      any = true;
      most = larger(most, std::abs(*phi - exact(cell_center(frame, index), frame.time)));
    });
  if (!any) throw Error(ExitCode::cannot_continue, "the last frame holds no surface");
  return most;
}

double surface_misplaced(const vdb::Frame& frame, const Formula& formula) {
  const SurfaceSamples phi(frame);
  const Expression exact(formula);
  const double h = frame.cell_size, far = 2 * h;
  const int n = frame.dimension == 2 ? 16 : 6;  // 1/256 and 1/216 of a cell
  double cells = 0;
  for_each_voxel(phi.block(), 1, [&](const Vec3& index, const float* value) {
    Vec3 x = cell_center(frame, index);
    if (frame.dimension == 2) x[2] = 0;
    const double here = exact(x, frame.time);
    if (!std::isfinite(here)) throw Error(ExitCode::cannot_continue, "the exact surface is not a finite number");
    if (std::abs(*value) >= far && std::abs(here) >= far)
      cells += (*value < 0) != (here < 0);
    else
      cells += share_between(frame, x, n, phi, exact);
  });
  return cells * std::pow(h, frame.dimension);
}

}  // namespace seiche
