#include "solid/body/thin_surface.h"

#include "geometry/mesh/segment_crossing.h"

namespace seiche {

namespace {

constexpr double slack = crossing_slack;

}  // namespace

template <int Dim>
ThinSurface<Dim>::ThinSurface(const SurfaceMesh& mesh)
    : surface_(build_surface_tree<Dim>(mesh, "a thin solid")), boxes_(surface_.nodes.size()) {
  for (std::size_t n = boxes_.size(); n-- > 0;) {
    const SurfaceTreeNode& node = surface_.nodes[n];
    for (int i = node.first; i < node.last; ++i)
      for (const int p : surface_.elements[surface_.order[i]]) boxes_[n].extend(surface_.points[p]);
    const Vec<Dim> grow = slack * boxes_[n].sizes();
    boxes_[n] = {boxes_[n].min() - grow, boxes_[n].max() + grow};
  }
}

template <int Dim>
bool ThinSurface<Dim>::meets_element(int element, const Vec<Dim>& p, const Vec<Dim>& q) const {
  const auto& x = surface_.points;
  const std::array<int, Dim>& e = surface_.elements[element];
  std::array<Vec<Dim>, Dim> facet;
  for (int i = 0; i < Dim; ++i) facet[i] = x[e[i]];
  return crossing<Dim>(p, q, facet).has_value();
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
    const SurfaceTreeNode& node = surface_.nodes[n];
    if (node.low_child > 0) todo.insert(todo.end(), {node.low_child, node.high_child});
    for (int i = node.first; node.low_child == 0 && i < node.last; ++i)
      if (meets_element(surface_.order[i], p, q)) return true;
  }
  return false;
}

template class ThinSurface<2>;
template class ThinSurface<3>;

}  // namespace seiche
