#pragma once
// Volume constraint of closed cavities whose walls are patches (SurfacePatch) of elastic solids.
#include "solid/body/elastic_motion.h"

namespace seiche {

template <int Dim>
struct WallPatch {
  const ElasticSolid<Dim>* solid;
  int body, patch;  // index of the solid in the scene; index of its patch
};

template <int Dim>
bool is_closed(const WallPatch<Dim>& wall);

// True if the closed patch lies around its liquid, not inside it.
template <int Dim>
bool is_vessel(const WallPatch<Dim>& wall, const Eigen::VectorXd& u);

// Walls of one cavity: closed patches, and open ones that are joined by the bodies that move with their pins. A patch
// belongs to at most one cavity.
template <int Dim>
using CavityWalls = std::vector<WallPatch<Dim>>;

template <int Dim>
bool has_open_wall(const CavityWalls<Dim>& walls);

// True if the patches end at pins such that closed loops (2D: pairs of ends) move together.
template <int Dim>
bool can_be_closed(const CavityWalls<Dim>& walls);

// Volume (m^Dim) enclosed at displacements u[k] of the nodes of wall k's solid; negative if the solids lie around it.
// Each loop at pins of one motion is closed by facets to its middle. The volume between these facets and the true
// closing surface is constant, since both move rigidly together.
template <int Dim>
double enclosed_volume(const CavityWalls<Dim>& walls, const std::vector<Eigen::VectorXd>& u);

// Its derivative by u[wall], m^(Dim - 1); zero at the pins of open patches.
template <int Dim>
Eigen::VectorXd enclosed_volume_gradient(const CavityWalls<Dim>& walls, std::size_t wall, const Eigen::VectorXd& u);

// Facets of a closed patch, oriented with the cavity inside. Corners are points of the whole surface.
template <int Dim>
SurfaceMesh wall_of_cavity(const ElasticSolid<Dim>& solid, int patch);

// Cavities whose volume is constrained.
template <int Dim>
std::vector<CavityWalls<Dim>> kept_cavities(const std::vector<Body<Dim>>& bodies, const ElasticMotions& motions);

// A step of dt from t that covers only a part of the planned `horizon` (s).
struct PartOfPlan {
  double t, dt, horizon;
};

// Corrects the nodal velocities w of each body for a shortened step. The volume of each constrained cavity must change
// in proportion to dt/horizon; its walls move along their normals until it does.
template <int Dim>
void keep_cavities(const std::vector<Body<Dim>>& bodies, const ElasticMotions& motions, const PartOfPlan& part,
                   std::vector<Eigen::VectorXd>& w);

}  // namespace seiche
