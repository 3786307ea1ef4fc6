#pragma once
// Output of an elastic body for frames: its elements and fields.
#include "solid/elastic/body.h"
#include "solid/mesh/volume_frame.h"

namespace seiche {

// Von Mises stress at the nodes (Pa): sqrt(3/2 s:s), s = dev sigma, sigma = P F^T / J. 2D is plane strain and includes
// the out-of-plane stress. A corner has the mean over its elements' quadrature points, weighted by w_q lambda_a(xi_q);
// a node on an edge has the mean of its corners.
template <int Dim>
std::vector<double> von_mises_stress(const ElasticBody<Dim>& body, const Eigen::VectorXd& u);

// The body at displacements u (m) and velocities v (m/s).
template <int Dim>
VolumeFrame volume_frame(const ElasticBody<Dim>& body, const ElasticSurface& surface, const Eigen::VectorXd& u,
                         const Eigen::VectorXd& v);

}  // namespace seiche
