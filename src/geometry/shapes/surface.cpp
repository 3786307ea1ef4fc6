// Contours of shapes for pictures and contact: triangles in 3D, segments by marching squares in 2D.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.h"
#include "geometry/shapes/makers.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace seiche {
namespace {

constexpr int margin = 2;  // nodes beyond the box, so that shapes that end on its border are contoured completely

// Nodes lower + i * spacing, 0 <= i < count, that cover a box and its margin.
template <int Dim>
struct Nodes {
  Vec<Dim> lower;
  double spacing;
  std::array<int, 3> count{1, 1, 1};
};

template <int Dim>
Nodes<Dim> cover(const Vec<Dim>& lower, const Vec<Dim>& upper, double spacing) {
  if (!(spacing > 0) || !(lower.array() < upper.array()).all()) {
    throw Error(ExitCode::bad_input, "a surface needs a positive spacing and a box that is not empty");
  }
  Nodes<Dim> nodes{lower - Vec<Dim>::Constant(margin * spacing), spacing, {1, 1, 1}};
  for (int a = 0; a < Dim; ++a)
    nodes.count[a] = int(std::ceil((upper[a] - lower[a]) / spacing - 1e-6)) + 1 + 2 * margin;
  return nodes;
}

template <int Dim>
std::vector<float> sample(const ShapeField<Dim>& field, const Nodes<Dim>& nodes) {
  std::vector<float> values;
  values.reserve(std::size_t(nodes.count[0]) * nodes.count[1] * nodes.count[2]);
  std::array<int, 3> i{0, 0, 0};
  for (i[2] = 0; i[2] < nodes.count[2]; ++i[2]) {
    for (i[1] = 0; i[1] < nodes.count[1]; ++i[1]) {
      for (i[0] = 0; i[0] < nodes.count[0]; ++i[0]) {
        Vec<Dim> x = nodes.lower;
        for (int a = 0; a < Dim; ++a) x[a] += i[a] * nodes.spacing;
        values.push_back(float(field(x)));
      }
    }
  }
  return values;
}

// Marching squares. Corners of a square are counter-clockwise: (0,0), (1,0), (1,1), (0,1). Edge e joins corners e and e
// + 1. A segment begins on an edge from inside to outside and ends on one from outside to inside. The inside is to its
// left.
class MarchingSquares {
 public:
  MarchingSquares(const std::vector<float>& values, const Nodes<2>& nodes) : values_(values), nodes_(nodes) {}

  SurfaceMesh run() {
    for (int j = 0; j + 1 < nodes_.count[1]; ++j) {
      for (int i = 0; i + 1 < nodes_.count[0]; ++i) add_square({i, j});
    }
    return std::move(mesh_);
  }

 private:
  using Node = std::array<int, 2>;

  static Node corner(const Node& square, int c) {
    constexpr int di[4] = {0, 1, 1, 0}, dj[4] = {0, 0, 1, 1};
    return {square[0] + di[c & 3], square[1] + dj[c & 3]};
  }
  int site(const Node& n) const { return n[0] + nodes_.count[0] * n[1]; }
  double value(const Node& n) const { return values_[site(n)]; }
  bool inside(const Node& n) const { return value(n) < 0; }

  void add_square(const Node& square) {
    double mean = 0;
    std::array<int, 2> outward{-1, -1}, inward{-1, -1};
    int turns = 0, entries = 0;
    for (int e = 0; e < 4; ++e) {
      const Node a = corner(square, e), b = corner(square, e + 1);
      mean += value(a) / 4;
      if (inside(a) && !inside(b)) outward[turns++] = e;
      if (!inside(a) && inside(b)) inward[entries++] = e;
    }
    if (turns == 0) return;
    // At a saddle the sign of the mean decides whether the inside is connected across the square.
    const bool crossed = turns == 2 && ((mean < 0) == (inward[0] < outward[0]));
    for (int k = 0; k < turns; ++k) {
      const int end = inward[crossed ? 1 - k : k];
      mesh_.segments.push_back({point(square, outward[k]), point(square, end)});
    }
  }

  // The zero crossing on an edge of a square. Both squares at the edge share the point.
  int point(const Node& square, int edge) {
    Node a = corner(square, edge), b = corner(square, edge + 1);
    if (site(b) < site(a)) std::swap(a, b);
    const auto [entry, is_new] = points_.try_emplace({site(a), site(b)}, int(mesh_.points.size()));
    if (is_new) {
      const double t = value(a) / (value(a) - value(b));
      const Vec<2> i(a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]));
      mesh_.points.push_back(extend<2>(Vec<2>(nodes_.lower + nodes_.spacing * i)));
    }
    return entry->second;
  }

  const std::vector<float>& values_;
  const Nodes<2>& nodes_;
  std::map<std::pair<int, int>, int> points_;
  SurfaceMesh mesh_;
};

SurfaceMesh contour(const std::vector<float>& values, const Nodes<2>& nodes) {
  return MarchingSquares(values, nodes).run();
}

SurfaceMesh contour(const std::vector<float>& values, const Nodes<3>& nodes) {
  return vdb::contour(values, nodes.count, nodes.lower, nodes.spacing);
}

// The part of a shape within a box.
template <int Dim>
struct CutOff : ShapeField<Dim> {
  const ShapeField<Dim>& inner;
  Vec<Dim> lower, upper;
  CutOff(const ShapeField<Dim>& field, const Vec<Dim>& low, const Vec<Dim>& high)
      : inner(field), lower(low), upper(high) {}
  double operator()(const Vec<Dim>& x) const override {
    return std::max(inner(x), (lower - x).cwiseMax(x - upper).maxCoeff());
  }
};

}  // namespace

template <int Dim>
SurfaceMesh shape_surface(const ShapeSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                          const Vec<Dim>& upper) {
  const auto field = make_shape<Dim>(spec, options);
  if (spec.has_facets()) return shape::read_shape_mesh<Dim>(spec, {options.cell_size, nullptr});
  if (spec.kind == "height_map") return closed_contour<Dim>(*field, options.cell_size, lower, upper);
  const Nodes<Dim> nodes = cover<Dim>(lower, upper, options.cell_size);
  return contour(sample<Dim>(*field, nodes), nodes);
}

template <int Dim>
SurfaceMesh closed_contour(const ShapeField<Dim>& field, double spacing, const Vec<Dim>& lower, const Vec<Dim>& upper) {
  const Nodes<Dim> nodes = cover<Dim>(lower, upper, spacing);
  return contour(sample<Dim>(CutOff<Dim>(field, lower, upper), nodes), nodes);
}

template SurfaceMesh closed_contour<2>(const ShapeField<2>&, double, const Vec<2>&, const Vec<2>&);
template SurfaceMesh closed_contour<3>(const ShapeField<3>&, double, const Vec<3>&, const Vec<3>&);
template SurfaceMesh shape_surface<2>(const ShapeSpec&, const ShapeOptions&, const Vec<2>&, const Vec<2>&);
template SurfaceMesh shape_surface<3>(const ShapeSpec&, const ShapeOptions&, const Vec<3>&, const Vec<3>&);

}  // namespace seiche
