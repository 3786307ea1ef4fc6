#pragma once
// The weight of the liquid beside elastic solids that are thinner than a cell.
#include "coupling/state.h"

namespace seiche {

// Pressure acts on the faces that body k seals as it is at the centres of the cells beside them. What the liquid
// between these and the body weighs, on each node, N:
//   sum_f s A rho g_a (d_low + d_high) e_a,   d the gaps of the cells with a row.
// So a wet body feels rho g times its volume along each axis, and a column of liquid all its weight. Collective.
template <int Dim>
Eigen::VectorXd weight_beside(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                              int k, const Vec<Dim>& gravity);

// Force and torque about the origin that forces on the nodes of body k add up to (ElasticMotion::extra_load).
template <int Dim>
Eigen::VectorXd total_load(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const Eigen::VectorXd& forces);

}  // namespace seiche
