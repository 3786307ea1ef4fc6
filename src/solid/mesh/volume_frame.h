#pragma once
// The elements of an elastic solid at one time, as plain data for frames.
#include <vector>

#include "base/vec.h"

namespace seiche {

// A mesh of triangles or tetrahedra as plain data. Empty for solids that are not elastic.
struct VolumeFrame {
  int dimension = 3, order = 1;
  std::vector<Vec3> rest, displacement, velocity;  // of the nodes: m, m, m/s
  std::vector<double> von_mises;                   // at the nodes, Pa
  std::vector<int> elements;                       // nodes of one element after the other, in the order of VTK
  std::vector<int> surface_nodes;                  // the nodes that are the points of the solid's surface, in its order
};

}  // namespace seiche
