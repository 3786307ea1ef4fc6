#pragma once
// Surface of a solid that may be thinner than a cell. Its two sides are told apart by crossing tests, since distances
// at grid nodes can miss it.
#include <Eigen/Geometry>

#include "geometry/mesh/surface_tree.h"

namespace seiche {

template <int Dim>
class ThinSurface {
 public:
  // mesh: the surface in the rest pose.
  explicit ThinSurface(const SurfaceMesh& mesh);

  // True if the segment from p to q crosses the surface; a segment within the plane of an element does not count.
  bool meets(const Vec<Dim>& p, const Vec<Dim>& q) const;

 private:
  bool meets_element(int element, const Vec<Dim>& p, const Vec<Dim>& q) const;

  SurfaceTree<Dim> surface_;
  std::vector<Eigen::AlignedBox<double, Dim>> boxes_;  // of the tree's nodes
};

}  // namespace seiche
