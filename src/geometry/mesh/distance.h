#pragma once
// Distance of points from the nearest of many triangles.
#include <array>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// Distance of x from the triangle a, b, c (m).
double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c);

// A tree of boxes over the triangles of a mesh. The mesh must outlive it. Several threads may query it at once.
class NearestTriangle {
 public:
  explicit NearestTriangle(const SurfaceMesh& mesh);
  // Distance of x from the surface, at most `bound` (m).
  double distance(const Vec3& x, double bound) const;
  // Calls visit(corners) for each triangle whose box meets the line through x along an axis.
  template <class Visit>
  void visit_line(const Vec3& x, int axis, const Visit& visit) const;

 private:
  static constexpr int most_depth = 128;  // of the stack: a tree of 2^31 triangles has 31 levels, two entries each
  // The triangles order_[first] ... order_[last - 1]. Children are nodes `low` and `low + 1`; low = 0: a leaf.
  struct Node {
    Vec3 lower, upper;
    int first = 0, last = 0, low = 0;
  };
  void split(int node, const std::vector<Vec3>& centers);
  Node enclose(int first, int last) const;
  std::array<Vec3, 3> corners(int triangle) const;

  const SurfaceMesh& mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

inline std::array<Vec3, 3> NearestTriangle::corners(int triangle) const {
  const auto& t = mesh_.triangles[triangle];
  return {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
}

template <class Visit>
void NearestTriangle::visit_line(const Vec3& x, int axis, const Visit& visit) const {
  std::array<int, most_depth> stack;
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    bool meets = true;
    for (const int a : {(axis + 1) % 3, (axis + 2) % 3}) meets &= node.lower[a] <= x[a] && x[a] <= node.upper[a];
    if (!meets) continue;
    if (node.low == 0) {
      for (int i = node.first; i < node.last; ++i) visit(corners(order_[i]));
      continue;
    }
    stack[depth++] = node.low;
    stack[depth++] = node.low + 1;
  }
}

}  // namespace seiche::mesh
