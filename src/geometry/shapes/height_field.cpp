// The shape below a height map: the polyline of a row of heights (2D), or a mesh sampled as other meshes are (3D).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/shapes/height_map.h"
#include "geometry/shapes/makers.h"
#include "geometry/shapes/sampled_mesh.h"

namespace seiche::shape {
namespace {

constexpr double spacing_in_cells = 0.5;  // of the nodes that stand for a map
constexpr double most_nodes = 4e6;        // of a map in 3D
constexpr double reach = 1000;            // how far edges go on, in extents of the map
constexpr double height_band = 5;         // voxels to each side, as of meshes

// Axes of a map. `first`, `second`: across, in the order of the coordinates; 2D: first alone. A map is seen from above,
// `first` to the right.
struct MapAxes {
  int up = 1, first = 0, second = 2;
  double sense = 1;          // of up
  bool right_handed = true;  // first, second, up

  MapAxes(const std::string& name, int dimension) {
    sense = name[0] == '-' ? -1 : 1;
    up = name.back() - 'x';
    first = up == 0 ? 1 : 0;
    second = 3 - up - first;
    if (dimension == 2) second = 2;
    right_handed = ((up == 1) ? -1 : 1) * sense > 0;  // x, z, y is left-handed
  }
};

// Equidistant nodes along one axis, where `samples` of a map are given.
struct MapNodes {
  double lower = 0, extent = 1;
  int samples = 2, count = 2;

  // Nodes at most `spacing` apart. Samples are nodes, unless they are closer than that.
  MapNodes(double low, double high, int n, double spacing) : lower(low), extent(high - low), samples(n) {
    const double own = extent / (samples - 1), ratio = own / spacing;
    const double wanted =
        ratio > 1 ? (samples - 1) * std::ceil(ratio) : std::min<double>(samples - 1, extent / spacing);
    count = int(std::max(1.0, std::ceil(wanted))) + 1;
  }
  double position(int node) const { return lower + extent * node / (count - 1); }
  double sample(int node) const { return double(samples - 1) * node / (count - 1); }
};

// Linear between samples; odd about both ends, so that straight lines go on.
template <class Value>
double between_samples(double at, int samples, const Value& value) {
  const double last = samples - 1;
  if (at < 0) return 2 * value(0) - between_samples(-at, samples, value);
  if (at > last) return 2 * value(samples - 1) - between_samples(2 * last - at, samples, value);
  const int low = std::min(int(at), samples - 2);
  return (1 - (at - low)) * value(low) + (at - low) * value(low + 1);
}

// Value at a node: that of the samples, averaged where they are closer than the nodes. Keeps straight lines.
template <class Value>
double at_node(const MapNodes& nodes, int node, const Value& value) {
  const double at = nodes.sample(node), step = double(nodes.samples - 1) / (nodes.count - 1);
  if (step <= 1) return between_samples(at, nodes.samples, value);
  const int parts = int(std::ceil(step));
  double sum = 0, weights = 0;
  for (int k = -parts; k <= parts; ++k) {
    const double weight = 1 - std::abs(k) / (parts + 1.0);
    weights += weight;
    sum += weight * between_samples(at + step * k / (parts + 1.0), nodes.samples, value);
  }
  return sum / weights;
}

// Coordinate along up of a sample.
class Levels {
 public:
  Levels(const ShapeSpec& spec, const HeightMap& map, const MapAxes& axes) : map_(map) {
    const double low = spec.lower[axes.up], high = spec.upper[axes.up];
    if (map.grey) {
      black_ = axes.sense > 0 ? low : high;
      span_ = axes.sense > 0 ? high - low : low - high;
      return;
    }
    const auto [least, most] = std::minmax_element(map.values.begin(), map.values.end());
    if (*least < low || *most > high)
      refuse(
          fmt::format("{}: its heights run from {:g} to {:g} m along {}, but the map's box from {:g} to {:g}; change "
                      "lower and upper",
                      spec.file.string(), *least, *most, "xyz"[axes.up], low, high));
  }
  double operator()(int column, int row) const { return black_ + span_ * map_.at(column, row); }

 private:
  const HeightMap& map_;
  double black_ = 0, span_ = 1;
};

// Heights at x in order, joined by straight lines. 2D.
struct Profile : ShapeField<2> {
  int up = 1;
  double sense = 1;
  std::vector<double> x, height;

  double operator()(const Vec<2>& at) const override {
    const double across = at[1 - up], along = at[up];
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, across);
    const int here = int(above - x.begin()) - 1;
    const double t = (across - x[std::size_t(here)]) / (x[std::size_t(here) + 1] - x[std::size_t(here)]);
    const double surface = (1 - t) * height[std::size_t(here)] + t * height[std::size_t(here) + 1];
    double best = std::abs(along - surface);
    for (int k = here; k >= 0 && across - x[std::size_t(k) + 1] < best; --k)
      best = std::min(best, from(k, across, along));
    for (int k = here + 1; k + 1 < int(x.size()) && x[std::size_t(k)] - across < best; ++k)
      best = std::min(best, from(k, across, along));
    return sense * (along - surface) < 0 ? -best : best;
  }

 private:
  // Distance from a segment.
  double from(int segment, double across, double along) const {
    const std::size_t k = std::size_t(segment);
    const Vec<2> a(x[k], height[k]), way(x[k + 1] - x[k], height[k + 1] - height[k]), to(across - a[0], along - a[1]);
    return (to - std::clamp(to.dot(way) / way.squaredNorm(), 0.0, 1.0) * way).norm();
  }
};

Field<2> make_profile(const ShapeSpec& spec, const HeightMap& map, const MapAxes& axes, double cell) {
  if (map.rows != 1)
    refuse(fmt::format("{}: a 2D scene takes one row of heights, not {} rows", spec.file.string(), map.rows));
  const Levels level(spec, map, axes);
  const MapNodes nodes(spec.lower[axes.first], spec.upper[axes.first], map.columns, spacing_in_cells * cell);
  auto profile = std::make_unique<Profile>();
  profile->up = axes.up;
  profile->sense = axes.sense;
  const auto add = [&](double x, double height) {
    profile->x.push_back(x);
    profile->height.push_back(height);
  };
  for (int i = 0; i < nodes.count; ++i)
    add(nodes.position(i), at_node(nodes, i, [&](int column) { return level(column, 0); }));
  const double far = reach * std::max(nodes.extent, cell);
  profile->x.insert(profile->x.begin(), profile->x.front() - far);
  profile->height.insert(profile->height.begin(), profile->height.front());
  add(profile->x.back() + far, profile->height.back());
  return profile;
}

// The closed block below a map, whose edges go on far beyond the rectangle.
class Terrain {
 public:
  Terrain(const ShapeSpec& spec, const HeightMap& map, const MapAxes& axes, double spacing)
      : axes_(axes),
        first_(spec.lower[axes.first], spec.upper[axes.first], map.columns, spacing),
        second_(spec.lower[axes.second], spec.upper[axes.second], map.rows, spacing),
        level_(spec, map, axes),
        rows_(map.rows) {
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < first_.count; ++i)
        along_first_.push_back(at_node(first_, i, [&](int column) { return level_(column, row_of(j)); }));
    far_ = reach * std::max({first_.extent, second_.extent, spec.upper[axes.up] - spec.lower[axes.up]});
    floor_ = axes.sense > 0 ? spec.lower[axes.up] - far_ : spec.upper[axes.up] + far_;
  }

  SurfaceMesh mesh() {
    const int wide = first_.count + 2, deep = second_.count + 2;
    for (int j = 0; j < deep; ++j)
      for (int i = 0; i < wide; ++i) add(place(first_, i), place(second_, j), height(i, j));
    const auto top = [wide](int i, int j) { return j * wide + i; };
    for (int j = 0; j + 1 < deep; ++j)
      for (int i = 0; i + 1 < wide; ++i) quad(top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1));
    std::vector<int> ring;  // counter-clockwise, if first, second and up are right-handed
    for (int i = 0; i + 1 < wide; ++i) ring.push_back(top(i, 0));
    for (int j = 0; j + 1 < deep; ++j) ring.push_back(top(wide - 1, j));
    for (int i = wide - 1; i > 0; --i) ring.push_back(top(i, deep - 1));
    for (int j = deep - 1; j > 0; --j) ring.push_back(top(0, j));
    close(ring);
    return std::move(mesh_);
  }

 private:
  int row_of(int j) const { return axes_.right_handed ? rows_ - 1 - j : j; }
  double place(const MapNodes& nodes, int i) const {
    return nodes.position(std::clamp(i - 1, 0, nodes.count - 1)) + far_ * ((i == nodes.count + 1) - (i == 0));
  }
  double height(int i, int j) const {
    const std::size_t column = std::size_t(std::clamp(i - 1, 0, first_.count - 1)), wide = std::size_t(first_.count);
    return at_node(second_, std::clamp(j - 1, 0, second_.count - 1),
                   [&](int row) { return along_first_[std::size_t(row) * wide + column]; });
  }
  void add(double first, double second, double up) {
    Vec3& x = mesh_.points.emplace_back();
    x[axes_.first] = first;
    x[axes_.second] = second;
    x[axes_.up] = up;
  }
  void triangle(int a, int b, int c) {
    if (!axes_.right_handed) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }
  void quad(int a, int b, int c, int d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  void close(const std::vector<int>& ring) {
    const int below = int(mesh_.points.size());
    for (const int n : ring) {
      const Vec3 x = mesh_.points[std::size_t(n)];
      add(x[axes_.first], x[axes_.second], floor_);
    }
    const int middle = int(mesh_.points.size()), count = int(ring.size());
    add(first_.lower + 0.5 * first_.extent, second_.lower + 0.5 * second_.extent, floor_);
    for (int n = 0; n < count; ++n) {
      const int next = (n + 1) % count;
      quad(below + n, below + next, ring[std::size_t(next)], ring[std::size_t(n)]);
      triangle(below + next, below + n, middle);
    }
  }

  MapAxes axes_;
  MapNodes first_, second_;
  Levels level_;
  int rows_;
  std::vector<double> along_first_;  // nodes along `first` in each row of samples, from the lower side
  double far_ = 0, floor_ = 0;
  SurfaceMesh mesh_;
};

struct TerrainShape : ShapeField<3> {
  std::unique_ptr<SampledMesh> distance;
  double operator()(const Vec<3>& x) const override { return (*distance)(x); }
};

Field<3> make_terrain(const ShapeSpec& spec, const HeightMap& map, const MapAxes& axes, double cell,
                      const ShapeOptions& options) {
  require_map_size(spec.file, std::min(map.columns, map.rows), 1);
  const double area =
      (spec.upper[axes.first] - spec.lower[axes.first]) * (spec.upper[axes.second] - spec.lower[axes.second]);
  const double wanted = spacing_in_cells * cell, spacing = std::max(wanted, std::sqrt(area / most_nodes));
  if (spacing > wanted && options.notes)
    options.notes->push_back(fmt::format("{}: the height map is taken at points {:.3g} m apart, more than half a cell",
                                         spec.file.filename().string(), spacing * spec.transform.scale));
  auto shape = std::make_unique<TerrainShape>();
  shape->distance = std::make_unique<SampledMesh>(Terrain(spec, map, axes, spacing).mesh(), cell, height_band);
  return shape;
}

}  // namespace

template <int Dim>
Field<Dim> make_height_map(const ShapeSpec& spec, const ShapeOptions& options) {
  if (!(options.cell_size > 0)) refuse("the shape 'height_map' needs a positive cell size to be sampled");
  const MapAxes axes(spec.up.value_or("y"), Dim);
  for (int a = 0; a < Dim; ++a)
    if (!(spec.lower[a] < spec.upper[a]))
      refuse("the box of the height map is empty; each component of lower must be less than that of upper");
  const HeightMap map = read_height_map(spec.file);
  const double cell = options.cell_size / spec.transform.scale;
  if constexpr (Dim == 2)
    return make_profile(spec, map, axes, cell);
  else
    return make_terrain(spec, map, axes, cell, options);
}

template Field<2> make_height_map<2>(const ShapeSpec&, const ShapeOptions&);
template Field<3> make_height_map<3>(const ShapeSpec&, const ShapeOptions&);

}  // namespace seiche::shape
