#include "geometry/mesh/surface_tree.h"

#include <Eigen/Dense>
#include <algorithm>
#include <map>

#include "base/error.h"
#include "geometry/mesh/facets.h"

namespace seiche {
namespace {

constexpr int leaf_size = 2;

template <int Dim>
void copy_used_points(const SurfaceMesh& mesh, const std::string& name, SurfaceTree<Dim>& s) {
  std::vector<int> place(mesh.points.size(), -1);
  for (std::array<int, Dim> element : facets_of<Dim>(mesh)) {
    for (int& p : element) {
      if (p < 0 || p >= static_cast<int>(mesh.points.size()))
        throw Error(ExitCode::bad_input,
                    name + ": its surface uses point " + std::to_string(p) + ", but there is no such point");
      if (place[p] < 0) {
        place[p] = static_cast<int>(s.points.size());
        s.points.push_back(truncate<Dim>(mesh.points[p]));
        s.source.push_back(p);
      }
      p = place[p];
    }
    s.elements.push_back(element);
  }
}

template <int Dim>
void share_out_points(SurfaceTree<Dim>& s) {
  std::vector<char> taken(s.points.size(), 0);
  s.own_points.resize(s.elements.size());
  s.own_edges.resize(s.elements.size());
  for (size_t e = 0; e < s.elements.size(); ++e)
    for (int p : s.elements[e])
      if (!taken[p]) {
        taken[p] = 1;
        s.own_points[e].push_back(p);
      }
}

void share_out_edges(SurfaceTree<3>& s) {
  std::map<std::array<int, 2>, int> known;
  for (size_t e = 0; e < s.elements.size(); ++e)
    for (int side = 0; side < 3; ++side) {
      const int a = s.elements[e][side], b = s.elements[e][(side + 1) % 3];
      const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
      if (!known.try_emplace(edge, 0).second) continue;
      s.own_edges[e].push_back(static_cast<int>(s.edges.size()));
      s.edges.push_back(edge);
    }
}

template <int Dim>
Vec<Dim> middle(const SurfaceTree<Dim>& s, int element) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (int p : s.elements[element]) sum += s.points[p];
  return sum / Dim;
}

// Splits the elements at the median along the longest side of the bounding box of their centroids. Returns the node.
template <int Dim>
int grow_tree(SurfaceTree<Dim>& s, int first, int last) {
  const int node = static_cast<int>(s.nodes.size());
  s.nodes.push_back({first, last, 0, 0});
  if (last - first <= leaf_size) return node;
  Vec<Dim> lower = middle(s, s.order[first]), upper = lower;
  for (int i = first; i < last; ++i) {
    lower = lower.cwiseMin(middle(s, s.order[i]));
    upper = upper.cwiseMax(middle(s, s.order[i]));
  }
  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  const int half = (first + last) / 2;
  std::nth_element(s.order.begin() + first, s.order.begin() + half, s.order.begin() + last,
                   [&](int a, int b) { return std::pair(middle(s, a)[axis], a) < std::pair(middle(s, b)[axis], b); });
  const int low = grow_tree(s, first, half), high = grow_tree(s, half, last);
  s.nodes[node].low_child = low;
  s.nodes[node].high_child = high;
  return node;
}

// The sides of an element run along it: 1 at its end and -1 at its start, or the edges of a triangle in its direction.
// In a closed surface those of all elements cancel.
bool is_closed(const SurfaceTree<2>& s) {
  std::vector<int> ends(s.points.size(), 0);
  for (const auto& [from, to] : s.elements) --ends[std::size_t(from)], ++ends[std::size_t(to)];
  return std::all_of(ends.begin(), ends.end(), [](int n) { return n == 0; });
}

bool is_closed(const SurfaceTree<3>& s) {
  std::map<std::array<int, 2>, int> sides;
  for (const std::array<int, 3>& element : s.elements)
    for (int side = 0; side < 3; ++side) {
      const int a = element[std::size_t(side)], b = element[std::size_t((side + 1) % 3)];
      sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 0; });
}

// By the divergence theorem, relative to the first point.
template <int Dim>
double signed_volume(const SurfaceTree<Dim>& s) {
  double sum = 0;
  for (const std::array<int, Dim>& element : s.elements) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int i = 0; i < Dim; ++i) corners.col(i) = s.points[element[i]] - s.points[0];
    sum += corners.determinant() / (Dim == 2 ? 2 : 6);
  }
  return sum;
}

}  // namespace

template <int Dim>
SurfaceTree<Dim> build_surface_tree(const SurfaceMesh& mesh, const std::string& name) {
  SurfaceTree<Dim> s;
  copy_used_points(mesh, name, s);
  if (s.elements.empty()) return s;
  share_out_points(s);
  if constexpr (Dim == 3) share_out_edges(s);
  s.order.resize(s.elements.size());
  for (size_t e = 0; e < s.order.size(); ++e) s.order[e] = static_cast<int>(e);
  grow_tree(s, 0, static_cast<int>(s.order.size()));
  s.closed = is_closed(s);
  s.volume = s.closed ? signed_volume(s) : 0;
  return s;
}

template SurfaceTree<2> build_surface_tree<2>(const SurfaceMesh&, const std::string&);
template SurfaceTree<3> build_surface_tree<3>(const SurfaceMesh&, const std::string&);

}  // namespace seiche
