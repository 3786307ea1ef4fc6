#pragma once
// Material points of an elastic body, followed as it deforms.
#include "solid/mesh/mesh.h"

namespace seiche {

struct ProbeSpec;

// A point at rest as an interpolation of nodes: X = sum weights_a X_a, the weights being shape functions.
struct MaterialPoint {
  int element = 0;
  Eigen::VectorXd weights;  // of the element's nodes
  double distance = 0;      // from the wanted point, m; 0 inside the mesh, to round-off
};

// The point of the mesh nearest to X at rest. If several elements contain X, the one with the lowest number counts.
template <int Dim>
MaterialPoint locate(const ElasticMesh<Dim>& mesh, const Vec<Dim>& X);

// The point that a displacement probe follows. Throws Error(bad_input) naming probe.where if it is outside the mesh by
// more than a fiftieth of the longest edge; sides deviate from round shapes by about as much.
template <int Dim>
MaterialPoint point_of_probe(const ElasticMesh<Dim>& mesh, const ProbeSpec& probe);

// Interpolates a nodal field (stacked node by node) at a material point.
template <int Dim>
Vec<Dim> interpolate(const ElasticMesh<Dim>& mesh, const MaterialPoint& point, const Eigen::VectorXd& values);

}  // namespace seiche
