#include "geometry/mesh/box_pairs.h"

#include <algorithm>
#include <numeric>

namespace seiche::mesh {
namespace {

constexpr int leaf_of_pairs = 4;  // triangles

}  // namespace

TriangleBoxes::TriangleBoxes(const SurfaceMesh& mesh) : order_(mesh.triangles.size()) {
  for (const auto& triangle : mesh.triangles) {
    Box& box = boxes_.emplace_back();
    for (const int p : triangle) box.extend(mesh.points[std::size_t(p)]);
  }
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.push_back(enclose(0, int(order_.size())));
  for (std::size_t node = 0; node < nodes_.size(); ++node) split(int(node));
  std::vector<Box> ordered;
  ordered.reserve(boxes_.size());
  for (const int t : order_) ordered.push_back(boxes_[std::size_t(t)]);
  boxes_ = std::move(ordered);
}

TriangleBoxes::Node TriangleBoxes::enclose(int first, int last) const {
  Node node{Box(), first, last, 0};
  for (int i = first; i < last; ++i) node.box.extend(boxes_[std::size_t(order_[std::size_t(i)])]);
  return node;
}

// Splits a node at the median of its triangles along its box's longest side.
void TriangleBoxes::split(int index) {
  const Node node = nodes_[std::size_t(index)];
  if (node.last - node.first <= leaf_of_pairs) return;
  Eigen::Index axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const auto twice_middle = [&](int t) {
    return boxes_[std::size_t(t)].min()[axis] + boxes_[std::size_t(t)].max()[axis];
  };
  const int middle = (node.first + node.last) / 2;
  std::nth_element(order_.begin() + node.first, order_.begin() + middle, order_.begin() + node.last,
                   [&](int s, int t) { return twice_middle(s) < twice_middle(t); });
  nodes_[std::size_t(index)].low = int(nodes_.size());
  nodes_.push_back(enclose(node.first, middle));
  nodes_.push_back(enclose(middle, node.last));
}

}  // namespace seiche::mesh
