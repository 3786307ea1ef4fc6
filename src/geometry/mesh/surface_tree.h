#pragma once
// A surface with a tree of its elements, for searches of what is near or crossed.
#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche {

// The elements order[first] up to order[last] below a node; children follow their parents; a leaf has low_child 0.
struct SurfaceTreeNode {
  int first = 0, last = 0, low_child = 0, high_child = 0;
};

// Each point and each edge belongs to one element that has it (representative triangles, Curtis et al. 2008): what is
// near is then found once.
template <int Dim>
struct SurfaceTree {
  std::vector<Vec<Dim>> points;  // at rest; those of no element are left out
  std::vector<int> source;       // of each the one in the mesh
  std::vector<std::array<int, Dim>> elements;
  std::vector<std::array<int, 2>> edges;                // none in 2D
  std::vector<std::vector<int>> own_points, own_edges;  // of each element
  std::vector<int> order;
  std::vector<SurfaceTreeNode> nodes;
  double volume = 0;  // m^3, negative: the solid is what lies outside
};

// `name` is for messages. Throws Error(bad_input) for elements with points that the mesh lacks.
template <int Dim>
SurfaceTree<Dim> build_surface_tree(const SurfaceMesh& mesh, const std::string& name);

}  // namespace seiche
