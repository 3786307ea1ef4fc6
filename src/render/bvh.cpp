#include "render/bvh.h"

#include <algorithm>
#include <cmath>

namespace seiche::render {
namespace {

constexpr std::uint32_t leaf_size = 4;

void include(Box& box, const Vec3f& x) {
  box.lower = box.lower.cwiseMin(x);
  box.upper = box.upper.cwiseMax(x);
}

Vec3f centroid(const Triangle& t) {
  return t.corner + (t.edge1 + t.edge2) / 3;
}

Box bounds(const std::vector<Triangle>& triangles, std::uint32_t begin, std::uint32_t end) {
  Box box{triangles[begin].corner, triangles[begin].corner};
  for (std::uint32_t i = begin; i < end; ++i) {
    include(box, triangles[i].corner);
    include(box, triangles[i].corner + triangles[i].edge1);
    include(box, triangles[i].corner + triangles[i].edge2);
  }
  return box;
}

bool crosses(const Ray& ray, const Vec3f& inverse, const Box& box, float t0, float t1) {
  for (int a = 0; a < 3; ++a) {
    const float x = (box.lower[a] - ray.origin[a]) * inverse[a], y = (box.upper[a] - ray.origin[a]) * inverse[a];
    // max/min in this order ignore the NaN of 0 * inf (a ray within a face)
    t0 = std::max(t0, std::min(x, y));
    t1 = std::min(t1, std::max(x, y) * 1.000001f);
  }
  return t0 <= t1;
}

}  // namespace

Hit intersect(const Ray& ray, const Triangle& triangle) {
  const Vec3f p = ray.direction.cross(triangle.edge2);
  const float determinant = triangle.edge1.dot(p);
  if (determinant == 0) return {};
  const float inverse = 1 / determinant;
  const Vec3f s = ray.origin - triangle.corner, q = s.cross(triangle.edge1);
  const float u = s.dot(p) * inverse, v = ray.direction.dot(q) * inverse;
  const float slack = 1e-6f;  // closes cracks by rounding along shared edges
  if (u < -slack || v < -slack || u + v > 1 + slack) return {};
  return {triangle.edge2.dot(q) * inverse, u, v, 0};
}

Bvh::Bvh(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  if (!triangles_.empty()) build(0, std::uint32_t(triangles_.size()));
}

// Nodes in depth-first order: the low child follows its parent. Split at the median along the longest axis.
void Bvh::build(std::uint32_t begin, std::uint32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.push_back({bounds(triangles_, begin, end), begin, end - begin});
  if (end - begin <= leaf_size) return;
  int axis = 0;
  nodes_[self].box.size().maxCoeff(&axis);
  const std::uint32_t middle = begin + (end - begin) / 2;
  const auto from = triangles_.begin();
  std::nth_element(from + begin, from + middle, from + end,
                   [axis](const Triangle& a, const Triangle& b) { return centroid(a)[axis] < centroid(b)[axis]; });
  build(begin, middle);
  const auto high = std::uint32_t(nodes_.size());
  build(middle, end);
  nodes_[self].first = high;
  nodes_[self].count = 0;
}

// Calls visit(index) for the triangles in leaves that the ray crosses before t1, until visit returns false.
template <class Visit>
void Bvh::walk(const Ray& ray, float t0, float& t1, Visit visit) const {
  if (nodes_.empty()) return;
  const Vec3f inverse = ray.direction.cwiseInverse();
  std::uint32_t stack[64];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t index = stack[--size];
    const Node& node = nodes_[index];
    if (!crosses(ray, inverse, node.box, t0, t1)) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = index + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (!visit(i)) return;
    }
  }
}

Hit Bvh::closest(const Ray& ray, float t0, float t1) const {
  Hit best;
  walk(ray, t0, t1, [&](std::uint32_t i) {
    const Hit hit = intersect(ray, triangles_[i]);
    if (hit.t > t0 && hit.t < t1) {
      best = hit;
      best.triangle = i;
      t1 = hit.t;
    }
    return true;
  });
  return best;
}

bool Bvh::any(const Ray& ray, float t0, float t1) const {
  bool found = false;
  walk(ray, t0, t1, [&](std::uint32_t i) {
    const Hit hit = intersect(ray, triangles_[i]);
    found = hit.t > t0 && hit.t < t1;
    return !found;
  });
  return found;
}

std::vector<Triangle> smooth_triangles(const SolidMesh& solids) {
  const auto& points = solids.mesh.points;
  const auto& corners = solids.mesh.triangles;
  std::vector<Vec3f> area;  // normals scaled by area
  std::vector<std::vector<std::uint32_t>> around(points.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const auto& [a, b, c] = corners[i];
    area.push_back((points[b] - points[a]).cross(points[c] - points[a]).cast<float>());
    for (const int corner : corners[i]) around[corner].push_back(i);
  }
  const float cosine = std::cos(40 * 3.14159265f / 180);
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const Vec3f corner = points[corners[i][0]].cast<float>();
    Triangle t{corner,
               points[corners[i][1]].cast<float>() - corner,
               points[corners[i][2]].cast<float>() - corner,
               {},
               i < solids.solid.size() ? solids.solid[i] : 0};
    for (int k = 0; k < 3; ++k) {
      Vec3f sum = area[i];
      for (const std::uint32_t j : around[corners[i][k]]) {
        if (j != i && area[i].dot(area[j]) > cosine * area[i].norm() * area[j].norm()) sum += area[j];
      }
      t.normals[k] = sum.normalized();
    }
    triangles.push_back(t);
  }
  return triangles;
}

}  // namespace seiche::render
