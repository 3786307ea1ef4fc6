#pragma once
// Surfaces of bodies and walls, prepared for the search for near pairs.
#include <algorithm>
#include <array>
#include <vector>

#include "geometry/mesh/surface_tree.h"
#include "solid/contact/contact.h"

namespace seiche {

namespace contact {

template <int Dim>
using Element = std::array<int, Dim>;

using TreeNode = SurfaceTreeNode;

template <int Dim>
using Surface = SurfaceTree<Dim>;

template <int Dim>
struct Wall {
  Vec<Dim> point, normal;
};

}  // namespace contact

template <int Dim>
struct ContactScene<Dim>::Data {
  std::vector<contact::Surface<Dim>> surfaces;
  std::vector<contact::Wall<Dim>> walls;
  std::vector<std::string> names;
  std::vector<BodyControl> control;
  std::vector<double> mass;
  std::vector<std::optional<double>> friction;
  std::vector<int> point_begin;  // first point of each body in the list of all points; one more entry than bodies
  // First index in the stacked velocities: of each body (-1: prescribed), and of each point of deformable bodies in the
  // list of all points (-1: on a rigid body).
  std::vector<int> first_dof, point_dof;
  std::vector<char> pinned;               // of each point
  std::vector<int> node_count;            // of each deformable body's mesh; 0 for others
  int size = 0;                           // of the stacked velocities
  std::vector<std::array<int, 2>> apart;  // pairs of bodies that never touch, ascending
  PairCoefficients pair_friction;

  // For pairs with the lower index first.
  bool may_touch(int a, int b) const {
    return !std::binary_search(apart.begin(), apart.end(), std::array<int, 2>{a, b});
  }
  // Coulomb's coefficient between a body and another one, or walls (-1).
  double friction_between(int a, int b) const;
  bool moves(int body) const { return first_dof[body] >= 0; }
  bool deforms(int body) const { return control[body] == BodyControl::deformable; }
  bool any_deforms() const {
    return std::find(control.begin(), control.end(), BodyControl::deformable) != control.end();
  }
  int node(int body, int point) const { return (point_dof[point] - first_dof[body]) / Dim; }
};

}  // namespace seiche
