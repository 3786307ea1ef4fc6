#pragma once
// A surface with a tree of its elements, for proximity and intersection queries.
#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace seiche {

// A node covers the elements order[first] ... order[last - 1]. Children follow their parents. A leaf has low_child = 0.
struct SurfaceTreeNode {
  int first = 0, last = 0, low_child = 0, high_child = 0;
};

// Each point and each edge is assigned to one of its elements (representative triangles, Curtis et al. 2008), so that
// queries find each pair once.
template <int Dim>
struct SurfaceTree {
  std::vector<Vec<Dim>> points;  // at rest; without points that no element uses
  std::vector<int> source;       // mesh index of each point
  std::vector<std::array<int, Dim>> elements;
  std::vector<std::array<int, 2>> edges;                // none in 2D
  std::vector<std::vector<int>> own_points, own_edges;  // assigned to each element
  std::vector<int> order;
  std::vector<SurfaceTreeNode> nodes;
  bool closed = true;  // each side of an element joins exactly one other; else the surface is a sheet
  double volume = 0;   // m^3 (2D: m^2) of a closed surface; negative: the solid is outside. 0 for a sheet
};

// `name` is for messages. Throws Error(bad_input) if an element uses a point that the mesh does not have.
template <int Dim>
SurfaceTree<Dim> build_surface_tree(const SurfaceMesh& mesh, const std::string& name);

}  // namespace seiche
