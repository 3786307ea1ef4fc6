#include "validate/measure/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "validate/measure/measures.h"

namespace seiche {

namespace {

const vdb::Grid& grid_of(const vdb::Frame& frame, const std::string& name, const std::string& what) {
  const auto found =
      std::find_if(frame.grids.begin(), frame.grids.end(), [&](const vdb::Grid& grid) { return grid.name == name; });
  if (found == frame.grids.end()) throw Error(ExitCode::cannot_continue, "the last frame holds no " + what);
  return *found;
}

}  // namespace

const vdb::Grid& velocity_of(const vdb::Frame& frame) {
  return grid_of(frame, "vel", "velocity");
}

namespace {

// Calls visit(index, values) for every voxel.
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

// A level set interpolated linearly between cell centres, constant outside of the outermost ones.
class SurfaceSamples {
 public:
  explicit SurfaceSamples(const vdb::Frame& frame) : frame_(frame) {
    const vdb::Grid& grid = grid_of(frame, vdb::level_set_name(frame), "surface");
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

// Share of the cell around `center` in which exactly one of the two is negative, by n^Dim points.
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

// Calls visit(axis, u_axis - exact) for the faces in the region.
template <class Visit>
void for_each_difference(const vdb::Frame& frame, const VectorFormula& formula, const Formula& region,
                         const Visit& visit) {
  const VectorExpression exact(formula);
  const Expression inside(region);
  for (const vdb::Block& block : velocity_of(frame).blocks)
    for_each_voxel(block, 3, [&](const Vec3& index, const float* u) {
      for (int axis = 0; axis < frame.dimension; ++axis) {
        Vec3 x = cell_center(frame, index);
        x[axis] -= 0.5 * frame.cell_size;
        if (inside(x, frame.time) < 0) visit(axis, u[axis] - exact.component(axis, x, frame.time));
      }
    });
}

}  // namespace

double velocity_difference(const vdb::Frame& frame, const VectorFormula& formula, const Formula& region) {
  Vec3 sums = Vec3::Zero(), counts = Vec3::Zero();
  for_each_difference(frame, formula, region, [&](int axis, double difference) {
    sums[axis] += difference * difference;
    counts[axis] += 1;
  });
  double mean = 0;
  for (int axis = 0; axis < frame.dimension; ++axis) {
    if (counts[axis] == 0) throw Error(ExitCode::cannot_continue, "no face lies in the region");
    mean += sums[axis] / counts[axis];
  }
  return std::sqrt(mean);
}

double largest_velocity_difference(const vdb::Frame& frame, const VectorFormula& formula, const Formula& region) {
  double largest = 0;
  bool any = false;
  for_each_difference(frame, formula, region, [&](int, double difference) {
    largest = larger(largest, std::abs(difference));
    any = true;
  });
  if (!any) throw Error(ExitCode::cannot_continue, "no face lies in the region");
  return largest;
}

double surface_difference(const vdb::Frame& frame, const Formula& formula) {
  const Expression exact(formula);
  double most = 0;
  bool any = false;
  for (const vdb::Block& block : grid_of(frame, vdb::level_set_name(frame), "surface").blocks)
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
  const int n = frame.dimension == 2 ? 16 : 6;  // resolves 1/256 and 1/216 of a cell
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
