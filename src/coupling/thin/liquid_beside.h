#pragma once
// The mass and the volume of the liquid beside elastic solids that are thinner than a cell.
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Pressure acts on the faces that body k seals as it is at the centres of the cells beside them, and these faces have
// no liquid of their own. What is between the centres and the body moves with it and weighs on it: of each unknown, kg,
//   sum_f s A rho (d_low + d_high),   d the gaps of the cells with a row, h/2 of those that sealed faces shut in,
// spread to the nodes as the face's velocity is their mean. So a wet body feels rho g times its volume along each axis,
// a column of liquid rests on it with all its weight, and light sheets do not move without inertia. Its momentum
// (kg m/s) is that of the velocity u_f which the face has had, of the liquid if it was open: a node that lagged or
// raced, seen by no face, brings none with it. What nodes of one face differ by from their mean wears off as motion
// through liquid over a cell does, |a| a/h. Collective.
struct LiquidBeside {
  Eigen::VectorXd mass, heavy, momentum;  // heavy: what of the mass weighs, not that of cells which the body fills
};
template <int Dim>
LiquidBeside liquid_beside(const Domain<Dim>& domain, const Fluids& fluids, const StepGeometry<Dim>& geometry,
                           const PressureRows<Dim>& rows, const State<Dim>& state, double dt, int k);

// Liquid beside thin elastic solids ends in whole cells, the solids between: what that counts too much, m^Dim,
//   sum_f n_a^2 A (h/2 - d) over the sides of a sealed face with liquid,
// the mean over the axes of what is between face and solid; what a cell in the solid has of liquid counts too much,
// too. Of the sum of all ranks. Collective.
template <int Dim>
double volume_beyond(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& geometry,
                     const CellField<Dim>& phi);

// Whether there are thin elastic solids.
template <int Dim>
bool has_thin_elastic(const Solids<Dim>& solids);

// Force and torque about the origin that forces on the nodes add up to (ElasticMotion::extra_load, reaction).
template <int Dim>
Eigen::VectorXd total_load(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const Eigen::VectorXd& forces);

}  // namespace seiche
