#pragma once
// The surface of a solid that may be thinner than a cell: what lies on two sides of it is told by crossing it, since
// distances at the nodes of a grid can miss it.
#include <Eigen/Geometry>

#include "geometry/mesh/surface_tree.h"

namespace seiche {

template <int Dim>
class ThinSurface {
 public:
  // In the rest pose.
  explicit ThinSurface(const SurfaceMesh& mesh);

  // Whether the segment from p to q meets the surface; one that runs within an element does not count.
  bool meets(const Vec<Dim>& p, const Vec<Dim>& q) const;

 private:
  bool meets_element(int element, const Vec<Dim>& p, const Vec<Dim>& q) const;

  SurfaceTree<Dim> surface_;
  std::vector<Eigen::AlignedBox<double, Dim>> boxes_;  // of the nodes of its tree
};

}  // namespace seiche
