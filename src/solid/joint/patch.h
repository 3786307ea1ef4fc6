#pragma once
// A patch of an elastic solid's nodes as a body that joints hold: its mean place and rotation.
#include "base/shape_spec.h"
#include "solid/elastic/solid.h"
#include "solid/joint/joint.h"

namespace seiche {

// Nodes n with weights w_n by mass, sum 1, at rest X_n from their mean.
template <int Dim>
struct JointPatch {
  std::vector<int> nodes;      // ascending
  std::vector<double> weight;  // w_n
  std::vector<Vec3> arm;       // X_n, m
  Vec3 center{0, 0, 0};        // mean at rest, m
};

// The nodes of `solid` that lie in `region` at rest. Throws Error(bad_input) with region.where: it holds no node,
// pinned ones, or too few to have a rotation. `joint`, `name`: for messages.
template <int Dim>
JointPatch<Dim> make_patch(const ElasticSolid<Dim>& solid, const ShapeSpec& region, const ShapeOptions& options,
                           const std::string& joint, const std::string& name);

// A patch with displacements u of the solid's nodes: place x -> R (x - center) + mean, R the rotation nearest to the
// deformation, and its velocities by those of the nodes.
template <int Dim>
struct PlacedPatch {
  JointedBody body;
  // (v, w) of the patch per unit of velocity of each unknown of the solid.
  std::vector<std::pair<int, Eigen::Matrix<double, 6, 1>>> rates;
};
template <int Dim>
PlacedPatch<Dim> place_patch(const JointPatch<Dim>& patch, const Eigen::VectorXd& u);

}  // namespace seiche
