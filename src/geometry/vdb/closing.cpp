#include "geometry/vdb/closing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/vdb/frame_checks.h"

namespace seiche::vdb {

double distance_from_sides(const std::array<int, 3>& cells, int dimension, double h, const std::array<int, 3>& voxel) {
  double inside = -std::numeric_limits<double>::infinity(), square = 0;
  for (std::size_t a = 0; a < std::size_t(dimension); ++a) {
    const double beyond = std::max(-0.5 - voxel[a], voxel[a] + 0.5 - cells[a]);
    inside = std::max(inside, beyond);
    square += std::pow(std::max(0.0, beyond), 2);
  }
  return h * (square > 0 ? std::sqrt(square) : inside);
}

Block closed_at_sides(const Block& block, const std::array<int, 3>& cells, int dimension, double h) {
  Block closed = block;
  if (block.values.empty()) return closed;
  std::array<std::size_t, 3> extent{};
  for (std::size_t a = 0; a < 3; ++a) {
    extent[a] = std::size_t(block.upper[a] - block.lower[a]);
    if (int(a) < dimension && block.lower[a] == 0) closed.lower[a] -= closing_layers;
    if (int(a) < dimension && block.upper[a] == cells[a]) closed.upper[a] += closing_layers;
  }
  closed.values.resize(voxel_count(closed.lower, closed.upper));
  float* value = closed.values.data();
  std::array<int, 3> ijk{};
  for (ijk[2] = closed.lower[2]; ijk[2] < closed.upper[2]; ++ijk[2])
    for (ijk[1] = closed.lower[1]; ijk[1] < closed.upper[1]; ++ijk[1])
      for (ijk[0] = closed.lower[0]; ijk[0] < closed.upper[0]; ++ijk[0], ++value) {
        std::array<std::size_t, 3> at{};
        for (std::size_t a = 0; a < 3; ++a)
          at[a] = std::size_t(std::clamp(ijk[a], block.lower[a], block.upper[a] - 1) - block.lower[a]);
        const float phi = block.values[(at[2] * extent[1] + at[1]) * extent[0] + at[0]];
        *value = std::max(phi, float(distance_from_sides(cells, dimension, h, ijk)));
      }
  return closed;
}

}  // namespace seiche::vdb
