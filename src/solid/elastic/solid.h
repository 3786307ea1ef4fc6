#pragma once
// An elastic solid of a scene: its finite elements, its surface, and what holds and drives it.
#include "base/scene.h"
#include "geometry/shapes/shapes.h"
#include "solid/elastic/body.h"
#include "solid/elastic/minimize.h"

namespace seiche {

// Nodes that move together as prescribed.
struct PinnedNodes {
  std::vector<int> nodes;  // ascending; no node is in two sets
  MotionSpec motion;
};

bool same_motion(const MotionSpec& a, const MotionSpec& b);

// A piece of an elastic solid's surface: a closed part of it, or, where pinned facets divide such a part, what lies
// between them.
template <int Dim>
struct SurfacePatch {
  // What would join a side of it to a point, corner -1, that moves with the pins that it ends at.
  struct Closing {
    std::array<int, Dim> corners;
    int pin;  // index of the pins, -1: the side's ends move differently
  };
  std::vector<std::array<int, Dim>> facets;  // corners are points of the surface
  std::vector<Closing> closings;             // empty: it is closed
  bool is_closed() const { return closings.empty(); }
};

// Sides of elements under a stress: force per area at rest, Pa.
struct LoadedSides {
  std::vector<BoundaryFace> faces;
  VectorFormula stress;
};

template <int Dim>
struct ElasticSolid {
  ElasticBody<Dim> body;
  ElasticSurface surface;  // at rest
  std::vector<PinnedNodes> pins;
  std::vector<SurfacePatch<Dim>> patches;  // without facets that are pinned where there are several of one part
  VectorFormula body_force;                // N/m^3
  std::vector<LoadedSides> tractions;
};

// Meshes the solid's shape at its element size, or reads its mesh, and finds the nodes that are pinned. [lower, upper]
// is the domain. Equal on all ranks. Throws Error(bad_input) naming spec.shape.where, or the where of a pin or
// traction, if the shape cannot be meshed, a pin holds no node, two pins with different motions hold the same one, a
// traction holds no side of an element, or a force is not finite at t = 0.
template <int Dim>
ElasticSolid<Dim> make_elastic_solid(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                                     const Vec<Dim>& upper);

// The displacements (m) that the pins prescribe at time t, each degree of freedom once, ascending.
template <int Dim>
Pins pins_at(const ElasticSolid<Dim>& solid, double t);

// The forces at time t beside gravity (N), of body_force and tractions, stacked node by node; empty where there are
// none.
template <int Dim>
Eigen::VectorXd applied_force_at(const ElasticSolid<Dim>& solid, double t);

// What the Cholesky factors of a body with this many unknowns take, bytes, roughly.
double factor_bytes(int dim, int unknowns);

// One line for the log: nodes, elements, their quality and edges.
template <int Dim>
std::string describe_mesh(const std::string& name, const ElasticMesh<Dim>& mesh);

}  // namespace seiche
