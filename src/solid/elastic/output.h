#pragma once
// What a frame shows of an elastic body: its elements with the fields that people look at.
#include "solid/elastic/body.h"
#include "solid/mesh/volume_frame.h"

namespace seiche {

// Von Mises stress of Cauchy's stress at the nodes, Pa: sqrt(3/2 s:s), s = dev sigma, sigma = P F^T / J, in 2D with the
// stress across the plane that holds it flat. A corner has the mean over its elements' quadrature points, weighted by
// w_q lambda_a(xi_q); a node between two corners has their mean.
template <int Dim>
std::vector<double> von_mises_stress(const ElasticBody<Dim>& body, const Eigen::VectorXd& u);

// The body at displacements u (m) and velocities v (m/s).
template <int Dim>
VolumeFrame volume_frame(const ElasticBody<Dim>& body, const ElasticSurface& surface, const Eigen::VectorXd& u,
                         const Eigen::VectorXd& v);

}  // namespace seiche
