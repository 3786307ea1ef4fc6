#include "solid/thin_surface.h"

#include <Eigen/Geometry>

namespace seiche {
namespace {

// Shares of a segment or element by which it counts as longer, so that what goes through an edge meets one of the
// elements there: far above rounding, far below what a grid sees.
constexpr double slack = 1e-9;

bool within(double share) {
  return share >= -slack && share <= 1 + slack;
}

double cross(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// p + s (q - p) = a + t (b - a)
bool meet(const Vec<2>& p, const Vec<2>& q, const Vec<2>& a, const Vec<2>& b) {
  const Vec<2> d = q - p, e = b - a;
  const double det = cross(d, e);
  if (std::abs(det) <= slack * d.norm() * e.norm()) return false;
  return within(cross(a - p, e) / det) && within(cross(a - p, d) / det);
}

// p + s (q - p) = a + u (b - a) + v (c - a) (Moeller, Trumbore 1997)
bool meet(const Vec<3>& p, const Vec<3>& q, const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
  const Vec<3> d = q - p, e = b - a, f = c - a, n = e.cross(f), from = p - a;
  const double det = -d.dot(n);
  if (std::abs(det) <= slack * d.norm() * n.norm()) return false;
  const Vec<3> m = from.cross(d);
  const double u = f.dot(m) / det, v = -e.dot(m) / det;
  return within(from.dot(n) / det) && within(u) && within(v) && within(u + v);
}

}  // namespace

template <int Dim>
ThinSurface<Dim>::ThinSurface(const SurfaceMesh& mesh)
    : surface_(contact::prepare_surface<Dim>(mesh, "a thin solid")), boxes_(surface_.nodes.size()) {
  for (std::size_t n = boxes_.size(); n-- > 0;) {
    const contact::TreeNode& node = surface_.nodes[n];
    for (int i = node.first; i < node.last; ++i)
      for (const int p : surface_.elements[surface_.order[i]]) boxes_[n].extend(surface_.points[p]);
    const Vec<Dim> grow = slack * boxes_[n].sizes();
    boxes_[n] = {boxes_[n].min() - grow, boxes_[n].max() + grow};
  }
}

template <int Dim>
bool ThinSurface<Dim>::meets_element(int element, const Vec<Dim>& p, const Vec<Dim>& q) const {
  const auto& x = surface_.points;
  const contact::Element<Dim>& e = surface_.elements[element];
  if constexpr (Dim == 2)
    return meet(p, q, x[e[0]], x[e[1]]);
  else
    return meet(p, q, x[e[0]], x[e[1]], x[e[2]]);
}

template <int Dim>
bool ThinSurface<Dim>::meets(const Vec<Dim>& p, const Vec<Dim>& q) const {
  const Vec<Dim> grow = slack * (q - p).cwiseAbs();
  const Eigen::AlignedBox<double, Dim> box(p.cwiseMin(q) - grow, p.cwiseMax(q) + grow);
  std::vector<int> todo;
  if (!boxes_.empty()) todo.push_back(0);
  while (!todo.empty()) {
    const int n = todo.back();
    todo.pop_back();
    if (!boxes_[n].intersects(box)) continue;
    const contact::TreeNode& node = surface_.nodes[n];
    if (node.low_child > 0) todo.insert(todo.end(), {node.low_child, node.high_child});
    for (int i = node.first; node.low_child == 0 && i < node.last; ++i)
      if (meets_element(surface_.order[i], p, q)) return true;
  }
  return false;
}

template class ThinSurface<2>;
template class ThinSurface<3>;

}  // namespace seiche
