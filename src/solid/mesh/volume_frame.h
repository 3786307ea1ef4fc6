#pragma once
// Elements of an elastic solid at one time, as plain data for frames.
#include <vector>

#include "base/vec.h"

namespace seiche {

// Triangles or tetrahedra with nodal fields. Without elements for deforming solids, empty for others that are not
// elastic.
struct VolumeFrame {
  int dimension = 3, order = 1;
  std::vector<Vec3> rest, displacement, velocity;  // of the nodes: m, m, m/s
  std::vector<double> von_mises;                   // at the nodes, Pa
  std::vector<int> elements;                       // nodes of one element after the other, in the order of VTK
  std::vector<int> surface_nodes;  // mesh nodes of the points of the solid's surface, in the surface's order
};

}  // namespace seiche
