#pragma once
// An elastic solid of a scene: finite elements, surface, pins and loads.
#include "base/solid_spec.h"
#include "geometry/shapes/mesh_sequence.h"
#include "geometry/shapes/shapes.h"
#include "solid/elastic/body.h"
#include "solid/elastic/minimize.h"

namespace seiche {

// Nodes with one prescribed motion.
struct PinnedNodes {
  std::vector<int> nodes;  // ascending; no node is in two sets
  MotionSpec motion;
};

bool same_motion(const MotionSpec& a, const MotionSpec& b);

// A patch of an elastic solid's surface: a closed connected part, or a piece of it between pinned facets.
template <int Dim>
struct SurfacePatch {
  // A facet that closes one open side of the patch. Corner -1 is the apex, a point that moves with the pin at that
  // side.
  struct Closing {
    std::array<int, Dim> corners;
    int pin;  // index of the pin; -1: the ends of the side move differently
  };
  std::vector<std::array<int, Dim>> facets;  // corners are points of the surface
  std::vector<Closing> closings;             // empty: the patch is closed
  bool is_closed() const { return closings.empty(); }
};

// Element sides under a stress: force per rest area, Pa.
struct LoadedSides {
  std::vector<BoundaryFace> faces;
  VectorFormula stress;
};

template <int Dim>
struct ElasticSolid {
  ElasticBody<Dim> body;
  ElasticSurface surface;  // at rest
  std::vector<PinnedNodes> pins;
  std::vector<SurfacePatch<Dim>> patches;  // if pinned facets divide a part: its pieces without those facets
  VectorFormula body_force;                // N/m^3
  std::vector<LoadedSides> tractions;
  std::shared_ptr<const MeshSequence> sequence;  // prescribes all nodes of a solid without elements; null: none
};

// Meshes the solid's shape at its element size, or reads its mesh, and finds the pinned nodes. [lower, upper] is the
// domain. Identical on all ranks. Throws Error(bad_input) naming spec.shape.where, or the where of a pin or traction:
// the shape cannot be meshed, a pin holds no node, two pins with different motions hold the same node, a traction
// covers no side of an element, or a force is not finite at t = 0.
template <int Dim>
ElasticSolid<Dim> make_elastic_solid(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower,
                                     const Vec<Dim>& upper);

// Nodes within a shape at rest, ascending. Sets the least distance of a node from it (m, negative inside).
template <int Dim>
std::vector<int> nodes_within(const ElasticMesh<Dim>& mesh, const ShapeSpec& shape, const ShapeOptions& options,
                              double& nearest);

// Displacements (m) prescribed by the pins at time t; each degree of freedom once, ascending.
template <int Dim>
Pins pins_at(const ElasticSolid<Dim>& solid, double t);

// Nodal forces (N) of body_force and tractions at time t, without gravity, stacked node by node. Empty if there are
// none.
template <int Dim>
Eigen::VectorXd applied_force_at(const ElasticSolid<Dim>& solid, double t);

// Rough memory (bytes) of the Cholesky factors of a body with this many unknowns.
double factor_bytes(int dim, int unknowns);

// One line for the log: nodes, elements, their quality and edge lengths.
template <int Dim>
std::string describe_mesh(const std::string& name, const ElasticMesh<Dim>& mesh);

}  // namespace seiche
