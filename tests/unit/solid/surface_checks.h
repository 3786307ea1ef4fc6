#pragma once
// Properties of closed surfaces that tests of solids check.
#include <Eigen/Geometry>

#include <array>
#include <map>
#include <utility>

#include "base/shape_spec.h"
#include "geometry/shapes/shapes.h"

namespace seiche::testing {

// True if each edge of a triangle (end of a segment) is met by exactly one neighbour in the opposite direction.
inline bool is_closed(const SurfaceMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : mesh.triangles) {
    for (int e = 0; e < 3; ++e) ++uses[{t[std::size_t(e)], t[std::size_t((e + 1) % 3)]}];
  }
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end() || back->second != 1) return false;
  }
  std::map<int, std::pair<int, int>> ends;
  for (const auto& s : mesh.segments) {
    ++ends[s[0]].first;
    ++ends[s[1]].second;
  }
  for (const auto& [point, count] : ends) {
    if (count != std::pair(1, 1)) return false;
  }
  return !uses.empty() || !ends.empty();
}

// Six times the signed volume of a tetrahedron.
inline double determinant(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

inline bool pierces(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  if (determinant(t[0], t[1], t[2], p) * determinant(t[0], t[1], t[2], q) >= 0) return false;
  const double a = determinant(p, q, t[0], t[1]), b = determinant(p, q, t[1], t[2]), c = determinant(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

// Number of edges that pass through the interior of a triangle with which they share no corner.
inline int self_intersections(const SurfaceMesh& mesh) {
  int count = 0;
  const auto corners = [&](const std::array<int, 3>& t) {
    return std::array<Vec3, 3>{mesh.points[std::size_t(t[0])], mesh.points[std::size_t(t[1])],
                               mesh.points[std::size_t(t[2])]};
  };
  const auto touches = [](const std::array<int, 3>& t, int p) { return t[0] == p || t[1] == p || t[2] == p; };
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> c = corners(t);
    const Vec3 low = c[0].cwiseMin(c[1]).cwiseMin(c[2]), high = c[0].cwiseMax(c[1]).cwiseMax(c[2]);
    for (const auto& s : mesh.triangles) {
      for (int e = 0; e < 3; ++e) {
        const int i = s[std::size_t(e)], j = s[std::size_t((e + 1) % 3)];
        if (i > j || touches(t, i) || touches(t, j)) continue;
        const Vec3 &p = mesh.points[std::size_t(i)], &q = mesh.points[std::size_t(j)];
        if ((p.cwiseMin(q).array() > high.array()).any() || (p.cwiseMax(q).array() < low.array()).any()) continue;
        count += pierces(p, q, c);
      }
    }
  }
  return count;
}

// A spec with every field set and nothing aligned with an axis.
inline ShapeSpec solid_shape(const std::string& kind) {
  ShapeSpec spec;
  spec.kind = kind;
  spec.where = "scene.toml:14";
  spec.lower = Vec3(-0.5, -0.25, -0.75);
  spec.upper = Vec3(0.25, 0.5, 0.5);
  spec.center = Vec3(0.1, -0.2, 0.3);
  spec.from = Vec3(-0.3, 0.1, -0.2);
  spec.to = Vec3(0.4, 0.5, 0.3);
  spec.point = Vec3(0.1, 0.2, 0.3);
  spec.normal = Vec3(1, 2, 3);
  spec.radius = 0.25;
  return spec;
}

inline TransformSpec skewed_transform(int dimension) {
  const Vec3 axis = dimension == 2 ? Vec3(0, 0, 1) : Vec3(1, -2, 0.5);
  return {1.3, {axis, 37}, Vec3(0.2, -0.1, dimension == 2 ? 0 : 0.3)};
}

}  // namespace seiche::testing
