#pragma once
// Mass and volume of the liquid beside elastic solids thinner than a cell.
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Liquid that moves with the thin elastic body k. On the faces that the body seals, pressure acts with its values at
// the centres of the adjacent cells. These faces have no liquid mass of their own. The liquid between the centres and
// the body moves with it and weighs on it. Its mass per unknown, kg, is
//   sum_f s A rho (d_low + d_high),
// with d the gaps of cells with a row, and h/2 for cells that sealed faces shut in. Nodes share it with the weights of
// the face velocity. A wet body then feels rho g times its volume along each axis. Columns of liquid rest on it with
// full weight, and light sheets have inertia. The momentum (kg m/s) is that of the last face velocity u_f, the liquid's
// if the face was open. Nodes that lag or race without effect on any face contribute none. The deviation a of a node
// from the face mean decays by |a| a/h, as motion through liquid over one cell does. Collective.
struct LiquidBeside {
  Eigen::VectorXd mass, heavy, momentum;  // heavy: the part of mass with weight; excludes cells filled by the body
};
template <int Dim>
LiquidBeside liquid_beside(const Domain<Dim>& domain, const Fluids& fluids, const StepGeometry<Dim>& geometry,
                           const PressureRows<Dim>& rows, const State<Dim>& state, double dt, int k);

// Kinetic energy of the liquid that moves with thin elastic bodies, with the nodes' velocities w, J (2D: J/m), less
// what a sum over cells counts for it by the velocities of faces. Nodes beside one face may move differently, as where
// a body turns within a cell. Summed over all ranks. Collective.
template <int Dim>
double kinetic_energy_beside(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                             const StepGeometry<Dim>& geometry, const State<Dim>& state);

// Liquid volume counted in excess beside thin elastic solids, m^Dim. The level set counts liquid up to the sealed
// faces, but the solid lies in between. The excess is
//   sum_f n_a^2 A (h/2 - d)   over the sides of sealed faces with liquid,
// the mean over the axes of the volume between face and solid. In cells with their centre inside the solid, the counted
// share of the half cell is in excess. Summed over all ranks; 0 without thin elastic solids. Collective.
template <int Dim>
double volume_beyond(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& geometry,
                     const CellField<Dim>& phi);

// True if any elastic solid is thin.
template <int Dim>
bool has_thin_elastic(const Solids<Dim>& solids);

// Force (N) and torque (N m) about the origin, six numbers in 2D as well, of nodal forces (N) at the displacements u
// (m). See ElasticMotion::extra_load, reaction.
template <int Dim>
Eigen::VectorXd total_load(const ElasticSolid<Dim>& solid, const Eigen::VectorXd& u, const Eigen::VectorXd& forces);

}  // namespace seiche
