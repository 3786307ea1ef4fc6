#include "exporting/liquid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/vdb/closing.h"

namespace seiche::exporting {
namespace {

using Cells = std::array<int, 3>;

std::size_t flat(const Cells& n, int i, int j, int k) {
  return (std::size_t(k) * std::size_t(n[1]) + std::size_t(j)) * std::size_t(n[0]) + std::size_t(i);
}

const vdb::Grid* find_grid(const vdb::Frame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.grids, name, &vdb::Grid::name);
  return found == frame.grids.end() ? nullptr : &*found;
}

// Moves the points in the layer of half a cell on both sides of a side onto it. Meshing puts one point into each voxel,
// so those of a voxel that the side cuts stand for it, and edges of the domain would be cut off by a quarter of a cell.
void snap_to_sides(const vdb::Frame& frame, const Cells& cells, std::vector<Vec3>& points) {
  const double reach = 0.5 * frame.cell_size * (1 - 1e-5);  // points are rounded to single precision
  for (Vec3& x : points)
    for (int a = 0; a < 3; ++a)
      for (const double side : {frame.lower[a], frame.lower[a] + frame.cell_size * cells[std::size_t(a)]})
        if (std::abs(x[a] - side) < reach) x[a] = side;
}

// A component of a field whose samples lie at lower + (i + offset) h.
struct Samples {
  const float* values;
  int stride;  // floats from one sample to the next
  Cells cells;
  std::array<double, 3> offset;
  const std::vector<float>* phi;  // at cell centres

  // Samples within the liquid count; the cell that a face sample belongs to, or the one below, must hold it.
  bool is_wet(int i, int j, int k) const {
    if ((*phi)[flat(cells, i, j, k)] < 0) return true;
    Cells below{i, j, k};
    for (std::size_t a = 0; a < 3; ++a) below[a] -= offset[a] == 0;
    if (std::min({below[0], below[1], below[2]}) < 0 || below == Cells{i, j, k}) return false;
    return (*phi)[flat(cells, below[0], below[1], below[2])] < 0;
  }
  float at(int i, int j, int k) const { return values[flat(cells, i, j, k) * std::size_t(stride)]; }
};

// Trilinear weights of the samples around x (in cells from `lower`), normalised over the wet ones; over all if none is.
float interpolate(const Samples& s, const Vec3& x) {
  Cells low{};
  Vec3 t;
  for (int a = 0; a < 3; ++a) {
    const double at = std::clamp(x[a] - s.offset[std::size_t(a)], 0.0, s.cells[std::size_t(a)] - 1.0);
    low[std::size_t(a)] = std::min(int(at), std::max(0, s.cells[std::size_t(a)] - 2));
    t[a] = at - low[std::size_t(a)];
  }
  double wet = 0, weight_of_wet = 0, all = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    Cells at = low;
    for (std::size_t a = 0; a < 3; ++a) {
      const int up = (corner >> a) & 1;
      weight *= up ? t[int(a)] : 1 - t[int(a)];
      at[a] = std::min(low[a] + up, s.cells[a] - 1);
    }
    const double value = weight * s.at(at[0], at[1], at[2]);
    all += value;
    if (weight > 0 && s.is_wet(at[0], at[1], at[2])) wet += value, weight_of_wet += weight;
  }
  constexpr double least = 1e-6;  // of the whole weight, below which rounding would show
  return float(weight_of_wet > least ? wet / weight_of_wet : all);
}

mesh::PointAttribute sample(const vdb::Frame& frame, const vdb::Grid& grid, const std::vector<float>& phi,
                            const Cells& cells, const std::vector<Vec3>& points) {
  const bool is_vector = grid.kind == vdb::GridKind::staggered_vector;
  const int width = is_vector ? 3 : 1;
  mesh::PointAttribute attribute{grid.name == "vel" ? "velocity" : grid.name, width, {}};
  attribute.values.reserve(points.size() * std::size_t(width));
  for (const Vec3& point : points) {
    const Vec3 x = (point - frame.lower) / frame.cell_size;
    for (int a = 0; a < width; ++a) {
      Samples samples{grid.blocks[0].values.data() + a, width, cells, {0.5, 0.5, 0.5}, &phi};
      if (is_vector) samples.offset[std::size_t(a)] = 0;
      attribute.values.push_back(interpolate(samples, x));
    }
  }
  return attribute;
}

}  // namespace

AttributedMesh liquid_mesh(const vdb::Frame& frame) {
  const vdb::Grid* surface = find_grid(frame, "surface");
  if (!surface || surface->blocks.size() != 1)
    throw Error(ExitCode::bad_input, fmt::format("frame {} holds no surface; output.frames of the scene must have "
                                                 "\"surface\" for meshes of the liquid",
                                                 frame.number));
  const Cells cells = surface->blocks[0].upper;
  const double h = frame.cell_size;
  const vdb::Block closed = vdb::closed_at_sides(surface->blocks[0], cells, 3, h);
  Cells nodes{};
  for (std::size_t a = 0; a < 3; ++a) nodes[a] = closed.upper[a] - closed.lower[a];
  AttributedMesh liquid;
  liquid.mesh = vdb::contour(closed.values, nodes, frame.lower + Vec3::Constant((0.5 - vdb::closing_layers) * h), h);
  snap_to_sides(frame, cells, liquid.mesh.points);
  const vdb::Grid* flow_side = find_grid(frame, vdb::level_set_name(frame));
  for (const vdb::Grid& grid : frame.grids) {
    if (grid.kind == vdb::GridKind::level_set || grid.blocks.size() != 1) continue;
    liquid.attributes.push_back(sample(frame, grid, flow_side->blocks[0].values, cells, liquid.mesh.points));
  }
  return liquid;
}

}  // namespace seiche::exporting
