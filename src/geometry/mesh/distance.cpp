#include "geometry/mesh/distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace seiche::mesh {
namespace {

constexpr int leaf_size = 4;

double squared_distance_to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double squared = ab.squaredNorm();
  const double share = squared > 0 ? std::clamp(ab.dot(x - a) / squared, 0.0, 1.0) : 0.0;
  return (a + share * ab - x).squaredNorm();
}

double squared_distance_to_box(const Vec3& x, const Vec3& lower, const Vec3& upper) {
  return (lower - x).cwiseMax(x - upper).cwiseMax(0.0).squaredNorm();
}

// True if x projects into the triangle: it is on the inner side of the plane through each edge along the normal.
bool is_over(const Vec3& x, const std::array<Vec3, 3>& corners, const Vec3& normal) {
  for (int e = 0; e < 3; ++e) {
    const Vec3 &p = corners[e], &q = corners[(e + 1) % 3];
    if ((q - p).cross(x - p).dot(normal) < 0) return false;
  }
  return true;
}

double squared_distance(const Vec3& x, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double squared = normal.squaredNorm();
  if (squared > 0 && is_over(x, t, normal)) {
    const double height = normal.dot(x - t[0]);
    return height * height / squared;
  }
  return std::min({squared_distance_to_segment(x, t[0], t[1]), squared_distance_to_segment(x, t[1], t[2]),
                   squared_distance_to_segment(x, t[2], t[0])});
}

}  // namespace

double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::sqrt(squared_distance(x, {a, b, c}));
}

NearestTriangle::NearestTriangle(const SurfaceMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Vec3> centers;
  centers.reserve(order_.size());
  for (const int t : order_) {
    const auto x = corners(t);
    centers.push_back((x[0] + x[1] + x[2]) / 3);
  }
  nodes_.push_back(enclose(0, int(order_.size())));
  for (std::size_t node = 0; node < nodes_.size(); ++node) split(int(node), centers);
}

NearestTriangle::Node NearestTriangle::enclose(int first, int last) const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Node node{Vec3::Constant(inf), Vec3::Constant(-inf), first, last, 0};
  for (int i = first; i < last; ++i) {
    for (const Vec3& p : corners(order_[i])) {
      node.lower = node.lower.cwiseMin(p);
      node.upper = node.upper.cwiseMax(p);
    }
  }
  return node;
}

// Splits a node at the median of its triangles along its box's longest side.
void NearestTriangle::split(int index, const std::vector<Vec3>& centers) {
  const Node node = nodes_[index];
  if (node.last - node.first <= leaf_size) return;
  Eigen::Index axis = 0;
  (node.upper - node.lower).maxCoeff(&axis);
  const int middle = (node.first + node.last) / 2;
  std::nth_element(order_.begin() + node.first, order_.begin() + middle, order_.begin() + node.last,
                   [&](int s, int t) { return centers[s][axis] < centers[t][axis]; });
  nodes_[index].low = int(nodes_.size());
  nodes_.push_back(enclose(node.first, middle));
  nodes_.push_back(enclose(middle, node.last));
}

double NearestTriangle::distance(const Vec3& x, double bound) const {
  double least = bound * bound;
  std::array<int, most_depth> stack;
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (squared_distance_to_box(x, node.lower, node.upper) >= least) continue;
    if (node.low == 0) {
      for (int i = node.first; i < node.last; ++i) least = std::min(least, squared_distance(x, corners(order_[i])));
      continue;
    }
    const Node &low = nodes_[node.low], &high = nodes_[node.low + 1];
    const bool low_first =
        squared_distance_to_box(x, low.lower, low.upper) < squared_distance_to_box(x, high.lower, high.upper);
    stack[depth++] = node.low + (low_first ? 1 : 0);  // the nearer child is popped first
    stack[depth++] = node.low + (low_first ? 0 : 1);
  }
  return std::sqrt(least);
}

}  // namespace seiche::mesh
