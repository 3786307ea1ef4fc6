#pragma once
// The weight and the volume of the liquid beside elastic solids that are thinner than a cell.
#include "coupling/state.h"

namespace seiche {

// Pressure acts on the faces that body k seals as it is at the centres of the cells beside them. What the liquid
// between these and the body weighs, on each node, N:
//   sum_f s A rho g_a (d_low + d_high) e_a,   d the gaps of the cells with a row.
// So a wet body feels rho g times its volume along each axis, and a column of liquid all its weight. Collective.
template <int Dim>
Eigen::VectorXd weight_beside(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                              int k, const Vec<Dim>& gravity);

// Liquid beside thin elastic solids ends in whole cells, the solids between: what that counts too much, m^Dim,
//   sum_f n_a^2 A (h/2 - d) over the sides of a sealed face with liquid,
// the mean over the axes of what is between face and solid; what a cell in the solid has of liquid counts too much,
// too. Of the sum of all ranks. Collective.
template <int Dim>
double volume_beyond(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const CellField<Dim>& phi);

// Whether there are thin elastic solids.
template <int Dim>
bool has_thin_elastic(const Setup<Dim>& setup);

// Force and torque about the origin that forces on the nodes of body k add up to (ElasticMotion::extra_load).
template <int Dim>
Eigen::VectorXd total_load(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const Eigen::VectorXd& forces);

}  // namespace seiche
