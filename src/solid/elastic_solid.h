#pragma once
// An elastic solid of a scene: its finite elements, its surface, and what holds and drives it.
#include "base/scene.h"
#include "levelset/shapes.h"
#include "solid/elastic_body.h"
#include "solid/elastic_minimize.h"

namespace seiche {

// Nodes that move together as prescribed.
struct PinnedNodes {
  std::vector<int> nodes;
  MotionSpec motion;
};

template <int Dim>
struct ElasticSolid {
  ElasticBody<Dim> body;
  ElasticSurface surface;  // at rest
  std::vector<PinnedNodes> pins;
  VectorFormula body_force;  // N/m^3
};

// Meshes the solid's shape at its element size, or reads its mesh, and finds the nodes that are pinned. Throws
// Error(bad_input) naming spec.shape.where.
template <int Dim>
ElasticSolid<Dim> make_elastic_solid(const SolidSpec& spec, const ShapeOptions& options);

// The displacements that the pins prescribe at time t, each degree of freedom once, ascending.
template <int Dim>
Pins pins_at(const ElasticSolid<Dim>& solid, double t);

// The impressed forces at time t beside gravity (N), stacked node by node; empty where there are none.
template <int Dim>
Eigen::VectorXd body_force_at(const ElasticSolid<Dim>& solid, double t);

}  // namespace seiche
