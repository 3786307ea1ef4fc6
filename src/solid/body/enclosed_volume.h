#pragma once
// Volume within closed walls that patches of elastic solids' surfaces (SurfacePatch) are, or are part of.
#include "solid/body/elastic_motion.h"

namespace seiche {

template <int Dim>
struct WallPatch {
  const ElasticSolid<Dim>* solid;
  int body, patch;  // its index in the scene; which of the solid's patches
};

// A closed patch, or patches, each of at most one cavity, that what moves with the pins they end at joins to closed
// walls.
template <int Dim>
using CavityWalls = std::vector<WallPatch<Dim>>;

// Whether the sides of the patches end at pins so that closed loops (2D: pairs of ends) move alike.
template <int Dim>
bool can_be_closed(const CavityWalls<Dim>& walls);

// What the walls enclose after displacements u[k] of the nodes of wall k's solid, m^Dim; negative where the solids lie
// around it. Each loop at pins of one motion is closed by facets that join it to its middle: how far off these are from
// what does close it does not change, since both move rigidly together.
template <int Dim>
double enclosed_volume(const CavityWalls<Dim>& walls, const std::vector<Eigen::VectorXd>& u);

// Its derivative by u[wall], m^(Dim - 1); zero for the pins of patches that are not closed.
template <int Dim>
Eigen::VectorXd enclosed_volume_gradient(const CavityWalls<Dim>& walls, std::size_t wall, const Eigen::VectorXd& u);

// The facets of a closed patch, with the cavity that it is the wall of as their inside; corners are points of the whole
// surface.
template <int Dim>
SurfaceMesh wall_of_cavity(const ElasticSolid<Dim>& solid, int patch);

// The cavities that keep their volume.
template <int Dim>
std::vector<CavityWalls<Dim>> kept_cavities(const std::vector<Body<Dim>>& bodies, const ElasticMotions& motions);

// A step of dt from t that goes only part of the way planned for `horizon`, s.
struct PartOfPlan {
  double t, dt, horizon;
};

// Corrects the velocities w of each body's nodes over the step: the walls of each cavity that must keep its volume go
// out or in along their normals as far as it takes that its volume changes in proportion to the way.
template <int Dim>
void keep_cavities(const std::vector<Body<Dim>>& bodies, const ElasticMotions& motions, const PartOfPlan& part,
                   std::vector<Eigen::VectorXd>& w);

}  // namespace seiche
