#pragma once
// What tests of solids ask of closed surfaces.
#include <map>
#include <utility>

#include "levelset/shapes.h"

namespace seiche::testing {

// Each edge of a triangle (each end of a segment) is met by exactly one neighbour that runs the other way.
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

// A spec with every field set, no part of it along an axis.
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
