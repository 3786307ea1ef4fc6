#pragma once
// Pairs of triangles whose boxes overlap.
#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "geometry/mesh/mesh.h"

namespace seiche::mesh {

// A tree of boxes over the triangles of a mesh.
class TriangleBoxes {
 public:
  explicit TriangleBoxes(const SurfaceMesh& mesh);

  // Calls visit(s, t) once for each pair of triangles with overlapping boxes. Stops and returns false beyond
  // `most` pairs.
  template <class Visit>
  bool visit_pairs(double most, const Visit& visit) const;

 private:
  using Box = Eigen::AlignedBox3d;
  // The triangles order_[first] ... order_[last - 1]. Children are nodes `low` and `low + 1`; low = 0: a leaf.
  struct Node {
    Box box;
    int first = 0, last = 0, low = 0;
  };
  void split(int node);
  Node enclose(int first, int last) const;

  std::vector<Box> boxes_;  // in the order of order_
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

template <class Visit>
bool TriangleBoxes::visit_pairs(double most, const Visit& visit) const {
  double count = 0;
  const auto try_pair = [&](int i, int j) {
    if (!boxes_[std::size_t(i)].intersects(boxes_[std::size_t(j)])) return;
    ++count;
    visit(order_[std::size_t(i)], order_[std::size_t(j)]);
  };
  std::vector<std::array<int, 2>> open{{0, 0}};  // pairs of nodes; equal: the pairs within one
  while (!open.empty() && count <= most) {
    const auto [a, b] = open.back();
    open.pop_back();
    const Node &one = nodes_[std::size_t(a)], &two = nodes_[std::size_t(b)];
    if (a != b && !one.box.intersects(two.box)) continue;
    if (one.low == 0 && two.low == 0) {
      for (int i = one.first; i < one.last; ++i)
        for (int j = a == b ? i + 1 : two.first; j < two.last; ++j) try_pair(i, j);
    } else if (a == b) {
      open.insert(open.end(), {{one.low, one.low}, {one.low, one.low + 1}, {one.low + 1, one.low + 1}});
    } else if (two.low == 0 || (one.low != 0 && one.last - one.first > two.last - two.first)) {
      open.insert(open.end(), {{one.low, b}, {one.low + 1, b}});
    } else {
      open.insert(open.end(), {{a, two.low}, {a, two.low + 1}});
    }
  }
  return count <= most;
}

}  // namespace seiche::mesh
