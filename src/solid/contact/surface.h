#pragma once
// Surfaces of bodies and walls, prepared for the search of near pairs.
#include <algorithm>
#include <array>
#include <vector>

#include "solid/contact/contact.h"

namespace seiche {

namespace contact {

template <int Dim>
using Element = std::array<int, Dim>;

// The elements order[first] up to order[last] below a node; children follow their parents; a leaf has low_child 0.
struct TreeNode {
  int first = 0, last = 0, low_child = 0, high_child = 0;
};

// Each point and each edge belongs to one element that has it (representative triangles, Curtis et al. 2008): what is
// near is then found once.
template <int Dim>
struct Surface {
  std::vector<Vec<Dim>> points;  // at rest; those of no element are left out
  std::vector<int> source;       // of each the one in the mesh
  std::vector<Element<Dim>> elements;
  std::vector<std::array<int, 2>> edges;                // none in 2D
  std::vector<std::vector<int>> own_points, own_edges;  // of each element
  std::vector<int> order;
  std::vector<TreeNode> nodes;
  double volume = 0;  // m^3, negative: the solid is what lies outside
};

template <int Dim>
struct Wall {
  Vec<Dim> point, normal;
};

template <int Dim>
Surface<Dim> prepare_surface(const SurfaceMesh& mesh, const std::string& name);

}  // namespace contact

template <int Dim>
struct ContactScene<Dim>::Data {
  std::vector<contact::Surface<Dim>> surfaces;
  std::vector<contact::Wall<Dim>> walls;
  std::vector<std::string> names;
  std::vector<BodyControl> control;
  std::vector<double> mass;
  std::vector<std::optional<double>> friction;
  std::vector<int> point_begin;  // of each body in the list of all points; one more entry than bodies
  // In the stacked velocities: where those of each body begin (-1: prescribed) and, of deformable bodies, of each point
  // in the list of all points (-1: of a rigid body).
  std::vector<int> first_dof, point_dof;
  std::vector<char> pinned;     // of each point
  std::vector<int> node_count;  // of each deformable body's mesh; 0 for others
  int size = 0;                 // of the stacked velocities

  bool moves(int body) const { return first_dof[body] >= 0; }
  bool deforms(int body) const { return control[body] == BodyControl::deformable; }
  bool any_deforms() const {
    return std::find(control.begin(), control.end(), BodyControl::deformable) != control.end();
  }
  int node(int body, int point) const { return (point_dof[point] - first_dof[body]) / Dim; }
};

}  // namespace seiche
