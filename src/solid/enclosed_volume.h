#pragma once
// Volume within the closed parts of an elastic solid's surface.
#include "solid/elastic_motion.h"

namespace seiche {

// What a part of the surface (ElasticSurface::part) encloses after displacements u of the nodes, m^Dim; negative where
// the solid lies around it: it is the wall of a cavity.
template <int Dim>
double enclosed_volume(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u);

// Its derivative by u, m^(Dim - 1).
template <int Dim>
Eigen::VectorXd enclosed_volume_gradient(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u);

// Of each node of the mesh the part of the surface that it is on, -1: it lies inside.
template <int Dim>
std::vector<int> parts_of_nodes(const ElasticSolid<Dim>& solid);

// The facets of one part, with the cavity that it is the wall of as their inside; corners are points of the whole
// surface.
template <int Dim>
SurfaceMesh wall_of_cavity(const ElasticSolid<Dim>& solid, int part);

// The velocities of the nodes over a step of dt that goes only part of the way that was planned for `horizon` at time
// t: straight, but for the walls of cavities that must keep their volume. Each of those goes out or in along its normal
// as far as it takes that its volume changes in proportion to the way.
template <int Dim>
Eigen::VectorXd velocity_over(const ElasticSolid<Dim>& solid, const ElasticMotion& motion, double t, double dt,
                              double horizon);

}  // namespace seiche
