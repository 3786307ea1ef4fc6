#include "solid/mesh/mesh.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace seiche {
namespace {

// Corners of the side opposite to corner i, seen from outside of a positive simplex.
template <int Dim>
std::array<int, Dim> side_corners(int i) {
  if constexpr (Dim == 2) return {(i + 1) % 3, (i + 2) % 3};
  constexpr std::array<std::array<int, 3>, 4> sides{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::array<int, Dim> r{};
  std::copy_n(sides[i].begin(), Dim, r.begin());
  return r;
}

// Index of the mid-edge node between corners a and b.
int edge_node(int dim, int a, int b) {
  for (int e = 0; e < elastic::edges_per_simplex(dim); ++e) {
    const auto [c, d] = elastic::edge_corners[e];
    if ((a == c && b == d) || (a == d && b == c)) return dim + 1 + e;
  }
  return -1;
}

template <int Dim>
std::vector<int> side_nodes(const ElasticMesh<Dim>& mesh, int element, int side) {
  const int* nodes = mesh.element(element);
  const auto corners = side_corners<Dim>(side);
  std::vector<int> r;
  for (int c : corners) r.push_back(nodes[c]);
  for (int e = 0; mesh.order == 2 && e < elastic::edges_per_simplex(Dim - 1); ++e) {
    const auto [a, b] = elastic::edge_corners[e];
    r.push_back(nodes[edge_node(Dim, corners[a], corners[b])]);
  }
  return r;
}

}  // namespace

template <int Dim>
std::vector<BoundaryFace> boundary_faces(const ElasticMesh<Dim>& mesh) {
  std::map<std::array<int, Dim>, std::pair<int, int>> single;  // sorted corners -> element, side
  for (int e = 0; e < mesh.element_count(); ++e) {
    for (int side = 0; side <= Dim; ++side) {
      std::array<int, Dim> key = side_corners<Dim>(side);
      for (int& c : key) c = mesh.element(e)[c];
      std::sort(key.begin(), key.end());
      if (const auto [at, is_new] = single.try_emplace(key, e, side); !is_new) single.erase(at);
    }
  }
  std::vector<std::pair<int, int>> sides;
  for (const auto& [key, side] : single) sides.push_back(side);
  std::sort(sides.begin(), sides.end());
  std::vector<BoundaryFace> faces;
  for (const auto& [e, side] : sides) faces.push_back({e, side_nodes(mesh, e, side)});
  return faces;
}

std::vector<std::vector<int>> facets_of_side(int dim, int order) {
  if (dim == 2)
    return order == 1 ? std::vector<std::vector<int>>{{0, 1}} : std::vector<std::vector<int>>{{0, 2}, {2, 1}};
  if (order == 1) return {{0, 1, 2}};
  return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
}

namespace {

// Numbers the parts of points that facets connect, in the order of their smallest point number.
void number_parts(ElasticSurface& surface) {
  std::vector<int> root(surface.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[size_t(i)] != i) i = root[size_t(i)] = root[size_t(root[size_t(i)])];
    return i;
  };
  const auto join = [&](int i, int j) {
    i = find(i), j = find(j);
    root[size_t(std::max(i, j))] = std::min(i, j);
  };
  for (const auto& f : surface.facets.segments) join(f[0], f[1]);
  for (const auto& f : surface.facets.triangles) join(f[0], f[1]), join(f[1], f[2]);
  surface.part.resize(root.size());
  for (size_t i = 0; i < root.size(); ++i) {
    const int first = find(int(i));
    surface.part[i] = first == int(i) ? surface.parts++ : surface.part[size_t(first)];
  }
}

}  // namespace

template <int Dim>
ElasticSurface surface_of(const ElasticMesh<Dim>& mesh) {
  ElasticSurface surface;
  std::vector<int> point(mesh.nodes.size(), -1);
  const auto point_of = [&](int node) {
    if (point[node] < 0) {
      point[node] = int(surface.nodes.size());
      surface.nodes.push_back(node);
      surface.facets.points.push_back(extend<Dim>(mesh.nodes[node]));
    }
    return point[node];
  };
  surface.sides = boundary_faces(mesh);
  for (const BoundaryFace& side : surface.sides)
    for (const std::vector<int>& f : facets_of_side(Dim, mesh.order)) {
      const int a = point_of(side.nodes[size_t(f[0])]), b = point_of(side.nodes[size_t(f[1])]);
      if constexpr (Dim == 2)
        surface.facets.segments.push_back({a, b});
      else
        surface.facets.triangles.push_back({a, b, point_of(side.nodes[size_t(f[2])])});
    }
  number_parts(surface);
  return surface;
}

template <int Dim>
void move_surface(ElasticSurface& surface, const ElasticMesh<Dim>& mesh, const Eigen::VectorXd& u) {
  for (size_t p = 0; p < surface.nodes.size(); ++p) {
    const int node = surface.nodes[p];
    surface.facets.points[p] = extend<Dim>(Vec<Dim>(mesh.nodes[node] + u.segment<Dim>(Dim * node)));
  }
}

template <int Dim>
ElasticMesh<Dim> promote_to_quadratic(const ElasticMesh<Dim>& linear) {
  ElasticMesh<Dim> r{2, linear.nodes, {}};
  std::map<std::pair<int, int>, int> middle;
  for (int e = 0; e < linear.element_count(); ++e) {
    const int* corner = linear.element(e);
    r.elements.insert(r.elements.end(), corner, corner + Dim + 1);
    for (int k = 0; k < elastic::edges_per_simplex(Dim); ++k) {
      const int a = corner[elastic::edge_corners[k][0]], b = corner[elastic::edge_corners[k][1]];
      const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), int(r.nodes.size()));
      if (is_new) r.nodes.push_back((linear.nodes[a] + linear.nodes[b]) / 2);
      r.elements.push_back(at->second);
    }
  }
  return r;
}

template <int Dim>
ElasticMesh<Dim> box_mesh(const Vec<Dim>& lower, const Vec<Dim>& upper, const IVec<Dim>& cells, int order) {
  ElasticMesh<Dim> mesh;
  const IVec<Dim> points = cells.array() + 1;
  IVec<Dim> stride = IVec<Dim>::Ones();
  for (int a = 1; a < Dim; ++a) stride[a] = stride[a - 1] * points[a - 1];
  const auto split = [](int index, const IVec<Dim>& counts) {
    IVec<Dim> r;
    for (int a = 0; a < Dim; index /= counts[a++]) r[a] = index % counts[a];
    return r;
  };
  for (int n = 0; n < points.prod(); ++n) {
    const Vec<Dim> share = split(n, points).template cast<double>().cwiseQuotient(cells.template cast<double>());
    mesh.nodes.push_back(lower + share.cwiseProduct(upper - lower));
  }
  for (int c = 0; c < cells.prod(); ++c) {
    std::array<int, Dim> axes;
    std::iota(axes.begin(), axes.end(), 0);
    do {  // a path from the low to the high corner, one axis after the other
      int node = split(c, cells).dot(stride), inversions = 0;
      const size_t first = mesh.elements.size();
      mesh.elements.push_back(node);
      for (int axis : axes) mesh.elements.push_back(node += stride[axis]);
      for (int i = 0; i < Dim; ++i)
        inversions += int(std::count_if(&axes[0], &axes[i], [&](int b) { return b > axes[i]; }));
      if (inversions % 2) std::swap(mesh.elements[first], mesh.elements[first + 1]);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return order == 1 ? mesh : promote_to_quadratic(mesh);
}

#define SEICHE_INSTANTIATE(Dim)                                                                      \
  template std::vector<BoundaryFace> boundary_faces<Dim>(const ElasticMesh<Dim>&);                   \
  template ElasticSurface surface_of<Dim>(const ElasticMesh<Dim>&);                                  \
  template void move_surface<Dim>(ElasticSurface&, const ElasticMesh<Dim>&, const Eigen::VectorXd&); \
  template ElasticMesh<Dim> promote_to_quadratic<Dim>(const ElasticMesh<Dim>&);                      \
  template ElasticMesh<Dim> box_mesh<Dim>(const Vec<Dim>&, const Vec<Dim>&, const IVec<Dim>&, int);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
