#pragma once
// Volume within the closed parts of an elastic solid's surface.
#include "solid/elastic_solid.h"

namespace seiche {

// What a part of the surface (ElasticSurface::part) encloses after displacements u of the nodes, m^Dim; negative where
// the solid lies around it: it is the wall of a cavity.
template <int Dim>
double enclosed_volume(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u);

// Its derivative by u, m^(Dim - 1).
template <int Dim>
Eigen::VectorXd enclosed_volume_gradient(const ElasticSolid<Dim>& solid, int part, const Eigen::VectorXd& u);

// The facets of one part, with the cavity that it is the wall of as their inside; corners are points of the whole
// surface.
template <int Dim>
SurfaceMesh wall_of_cavity(const ElasticSolid<Dim>& solid, int part);

}  // namespace seiche
