#include "geometry/mesh/intersections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>

#include "base/disjoint_sets.h"
#include "geometry/mesh/box_pairs.h"
#include "geometry/mesh/exact_orientation.h"
#include "geometry/mesh/pairs.h"

namespace seiche::mesh {
namespace {

using Triangle = std::array<int, 3>;

constexpr double most_box_pairs = 100;  // a triangle: even meshes have some 20, fans as many as triangles

// An axis along which the triangle's projection has an area, if possible the one with the largest area; -1: none.
int view(const Vec3& a, const Vec3& b, const Vec3& c) {
  int widest = 0;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&widest);
  for (int k = 0; k < 3; ++k)
    if (const int axis = (widest + k) % 3; orientation(a, b, c, axis) != 0) return axis;
  return -1;
}

bool lies_in(const Vec3& p, const std::array<Vec3, 3>& t, int axis) {
  const int ab = orientation(t[0], t[1], p, axis), bc = orientation(t[1], t[2], p, axis),
            ca = orientation(t[2], t[0], p, axis);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

bool meet_in_plane(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const int axis = view(t[0], t[1], t[2]);
  if (axis < 0) return false;
  if (lies_in(p, t, axis)) return true;
  for (int k = 0; k < 3; ++k)
    if (segments_meet_in_plane(p, q, t[k], t[(k + 1) % 3], axis)) return true;
  return false;
}

bool segment_meets(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const int above = orientation(t[0], t[1], t[2], p), below = orientation(t[0], t[1], t[2], q);
  if (above * below > 0) return false;
  if (above == 0 && below == 0) return meet_in_plane(p, q, t);
  const int ab = orientation(p, q, t[0], t[1]), bc = orientation(p, q, t[1], t[2]), ca = orientation(p, q, t[2], t[0]);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

std::array<Vec3, 3> corners(const SurfaceMesh& mesh, const Triangle& t) {
  return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

// The triangle's corners, those shared with the other triangle first, and the number of shared corners.
std::pair<Triangle, int> shared_first(const Triangle& t, const Triangle& other) {
  Triangle sorted{}, rest{};
  int shared = 0, others = 0;
  for (const int p : t)
    (std::find(other.begin(), other.end(), p) != other.end() ? sorted[shared++] : rest[others++]) = p;
  std::copy_n(rest.begin(), others, sorted.begin() + shared);
  return {sorted, shared};
}

// True if the corners of t from `first` on lie strictly on one side of the plane of s.
bool is_beside(const std::array<Vec3, 3>& t, int first, const std::array<Vec3, 3>& s) {
  const int side = orientation(s[0], s[1], s[2], t[first]);
  if (side == 0) return false;
  for (int k = first + 1; k < 3; ++k)
    if (orientation(s[0], s[1], s[2], t[k]) != side) return false;
  return true;
}

// True if both triangles lie in one plane and on the same side of their common edge.
bool folded(const SurfaceMesh& mesh, const Triangle& s, const Triangle& t) {
  const Vec3 &u = mesh.points[s[0]], &v = mesh.points[s[1]], &a = mesh.points[s[2]], &b = mesh.points[t[2]];
  if (orientation(u, v, a, b) != 0) return false;
  const int axis = view(u, v, a);
  return axis >= 0 && orientation(u, v, a, axis) == orientation(u, v, b, axis);
}

bool any_side_meets(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t) {
  for (int k = 0; k < 3; ++k)
    if (segment_meets(s[k], s[(k + 1) % 3], t)) return true;
  return false;
}

bool has_area(const SurfaceMesh& mesh, const Triangle& t) {
  return view(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]) >= 0 &&
         (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).norm() > 0;
}

// A group number for each point: equal for the corners of connected triangles without area, -1 for all other points.
std::vector<int> sliver_points(const SurfaceMesh& mesh) {
  DisjointSets sets(mesh.points.size());
  std::vector<int> group(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    if (has_area(mesh, t)) continue;
    sets.join(t[0], t[1]);
    sets.join(t[0], t[2]);
    for (const int p : t) group[p] = 0;
  }
  for (std::size_t p = 0; p < group.size(); ++p)
    if (group[p] == 0) group[p] = sets.root(int(p));
  return group;
}

// The plane of a triangle, by a normal that is not of unit length.
struct FacetPlane {
  Vec3 origin, normal;
  double size = 0;  // product of the lengths of two sides
};

FacetPlane plane_of(const SurfaceMesh& mesh, const Triangle& t) {
  const Vec3 &a = mesh.points[t[0]], u = mesh.points[t[1]] - a, v = mesh.points[t[2]] - a;
  return {a, u.cross(v), u.norm() * v.norm()};
}

// True if the corners that `other` does not share with t lie on one side of its plane beyond doubt, so that the two do
// not intersect. False for one triangle.
bool is_clear_of(const FacetPlane& plane, const SurfaceMesh& mesh, const Triangle& t, const Triangle& other) {
  constexpr double rounding = 1e-14;  // some forty units in the last place: those of normal and product, with room
  int above = 0, below = 0, apart = 0;
  for (const int p : other) {
    if (p == t[0] || p == t[1] || p == t[2]) continue;
    const Vec3 x = mesh.points[p] - plane.origin;
    const double height = plane.normal.dot(x), doubt = rounding * plane.size * x.lpNorm<1>();
    ++apart;
    above += height > doubt;
    below += height < -doubt;
  }
  return apart > 0 && (above == apart || below == apart);
}

bool share_sliver(const std::vector<int>& group, const Triangle& s, const Triangle& t) {
  for (const int p : s)
    for (const int q : t)
      if (group[p] >= 0 && group[p] == group[q]) return true;
  return false;
}

// The triangles with area, by edge.
std::map<Edge, std::vector<int>> triangles_at_edges(const SurfaceMesh& mesh) {
  std::map<Edge, std::vector<int>> result;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    if (!has_area(mesh, c)) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(c[k], c[(k + 1) % 3]);
      result[{low, high}].push_back(int(t));
    }
  }
  return result;
}

// All pairs of triangles that may intersect, lower index first, each once: those that share an edge, and those where an
// edge of one is close to the other. If triangles meet, an edge of one meets the other.
std::vector<std::array<int, 2>> candidates(const SurfaceMesh& mesh) {
  const auto owners = triangles_at_edges(mesh);
  std::vector<Edge> edges;
  std::vector<const std::vector<int>*> at;
  std::vector<std::array<int, 2>> pairs;
  for (const auto& [edge, triangles] : owners) {
    edges.push_back(edge);
    at.push_back(&triangles);
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (std::size_t j = i + 1; j < triangles.size(); ++j) pairs.push_back({triangles[i], triangles[j]});
  }
  for (const auto& [edge, t] : close_pairs(mesh.points, edges, mesh.triangles))
    for (const int s : *at[edge]) pairs.push_back({std::min(s, t), std::max(s, t)});
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

bool segments_meet_in_plane(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, int axis) {
  const int pa = orientation(a, b, p, axis), qa = orientation(a, b, q, axis);
  const int ap = orientation(p, q, a, axis), bp = orientation(p, q, b, axis);
  if (pa != 0 || qa != 0 || ap != 0 || bp != 0) return pa * qa <= 0 && ap * bp <= 0;
  for (int k = 0; k < 3; ++k)  // collinear
    if (std::max(p[k], q[k]) < std::min(a[k], b[k]) || std::max(a[k], b[k]) < std::min(p[k], q[k])) return false;
  return true;
}

// Triangles that share one corner meet elsewhere if and only if the side opposite to it in one of them meets the other:
// the common part is convex, and a ray from the corner leaves one of them first.
bool intersect(const SurfaceMesh& mesh, const Triangle& one, const Triangle& two) {
  const auto [s, shared] = shared_first(one, two);
  const Triangle t = shared_first(two, one).first;
  if (shared == 3) return true;
  if (shared == 2) return folded(mesh, s, t);
  const auto x = corners(mesh, s), y = corners(mesh, t);
  if (is_beside(y, shared, x) || is_beside(x, shared, y)) return false;
  if (shared == 0) return any_side_meets(x, y) || any_side_meets(y, x);
  return segment_meets(x[1], x[2], y) || segment_meets(y[1], y[2], x);
}

std::vector<std::array<int, 2>> self_intersections(const SurfaceMesh& mesh) {
  std::vector<char> counts;
  counts.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) counts.push_back(has_area(mesh, t));
  const std::vector<int> group = sliver_points(mesh);
  std::vector<FacetPlane> planes;
  planes.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) planes.push_back(plane_of(mesh, t));
  std::vector<std::array<int, 2>> found;
  const auto look_at = [&](int s, int t) {
    const Triangle &one = mesh.triangles[s], &two = mesh.triangles[t];
    if (is_clear_of(planes[s], mesh, one, two) || is_clear_of(planes[t], mesh, two, one)) return;
    if (counts[s] && counts[t] && !share_sliver(group, one, two) && intersect(mesh, one, two))
      found.push_back({std::min(s, t), std::max(s, t)});
  };
  if (TriangleBoxes(mesh).visit_pairs(most_box_pairs * double(mesh.triangles.size()), look_at)) {
    std::sort(found.begin(), found.end());
    return found;
  }
  found.clear();
  for (const auto& [s, t] : candidates(mesh)) look_at(s, t);
  return found;
}

}  // namespace seiche::mesh
