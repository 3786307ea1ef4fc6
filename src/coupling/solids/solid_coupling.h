#pragma once
// How solids with unknowns and liquid act on each other through the faces that the bodies close.
#include <algorithm>
#include <optional>

#include "coupling/solids/cavity_volume.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"
#include "solid/energy/rigid_problem.h"
#include "solid/energy/velocity_potential.h"

namespace seiche {

// The unknowns are the velocities of the participants over the horizon, in the order of the scene. e(v) = 1/2 v'Mv -
// v'push is the energy of their inertia without liquid.
template <int Dim>
struct SolidCoupling {
  std::vector<int> bodies;    // indices of those with unknowns, one a block
  std::vector<int> first{0};  // first unknown of each, and the number of unknowns
  // (J v)_c = sum_f +- s_f v(x_f).e_f: volume that the bodies' motion takes out of cell c, per face area. A_f J' p is
  // what the pressure p does to each unknown. Columns of what is held are zero.
  BlockColumns J;
  BlockColumns J_held;   // the columns of J of nodes that are held, alone
  SparseMatrix mass;     // M; of elastic bodies dt H (M/gamma^2 + C/gamma), see IncrementalPotential
  Eigen::VectorXd push;  // M v*, v* the velocities without liquid, contact and elastic forces
  Eigen::VectorXd free;  // velocities that the bodies would have about, for scale
  // v* where it is known without the solve: of rigid bodies.
  Eigen::VectorXd target;
  // What makes up for the difference between a body's volume and the one its face shares add up to, so that wet bodies
  // feel exactly rho g times their volume: of rigid bodies force and torque (N, N m), of thin elastic ones forces on
  // their nodes; zero for others.
  Eigen::VectorXd buoyancy_correction;
  // Of liquid that moves with thin elastic bodies, part of `mass` and `push` (thin_weight.h): kg, and kg m/s before the
  // step.
  Eigen::VectorXd mass_beside, momentum_beside;
  std::vector<Freedom> freedom;
  Eigen::VectorXd held;                                // velocities of what is held
  std::shared_ptr<const VelocityPotential> potential;  // null: none
  std::vector<CavityConstraint<Dim>> cavities;
  std::vector<std::shared_ptr<const CellFluxes>> cell_fluxes;  // of each block: flux that its faces do not show

  int size() const { return first.back(); }
  bool is_held(Eigen::Index i) const { return freedom[std::size_t(i)] == Freedom::fixed; }
  bool any_held() const { return std::find(freedom.begin(), freedom.end(), Freedom::fixed) != freedom.end(); }
};

// What the parts of a coupling are gathered in.
template <int Dim>
struct CouplingParts {
  SolidCoupling<Dim>& coupling;
  std::vector<Eigen::Triplet<double>> mass = {};
  std::vector<double> sums = {};          // over the ranks, see Participant::couple
  std::vector<BodyEntries> entries = {};  // columns that interactions may correct
  std::vector<std::shared_ptr<const VelocityPotential>> potentials = {};
  std::optional<CellField<Dim, char>> open = {};  // open_cells(), once they are asked for
};

// Collective.
template <int Dim>
SolidCoupling<Dim> couple_solids(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry,
                                 const PressureRows<Dim>& rows, const NullSpace& closed, const State<Dim>& state,
                                 double dt, double horizon);

// The bodies after a solve gave them the velocities v over the horizon.
template <int Dim>
void set_velocities(const Domain<Dim>& domain, const Solids<Dim>& solids, const SolidCoupling<Dim>& coupling,
                    const Eigen::VectorXd& v, double horizon, StepGeometry<Dim>& geometry, State<Dim>& state);

// Tells the bodies what holds them. `reactions`: forces that hold the unknowns, N; zero where they
// are free.
template <int Dim>
void set_reactions(const SolidCoupling<Dim>& coupling, const Eigen::VectorXd& reactions, State<Dim>& state);

// What is held moves the liquid whatever the solve finds: into the geometry before the solve, together with the fluxes
// that faces do not show.
template <int Dim>
void set_held_velocities(const Domain<Dim>& domain, const SolidCoupling<Dim>& coupling, StepGeometry<Dim>& geometry);

// The unknowns' values over a coming step of dt: as the last solve left them, but for what interactions keep to. Of
// each participant, and stacked.
template <int Dim>
std::vector<Eigen::VectorXd> each_velocity_over(const Solids<Dim>& solids, const State<Dim>& state, double dt);
template <int Dim>
Eigen::VectorXd velocities_over(const Solids<Dim>& solids, const State<Dim>& state, double dt);

}  // namespace seiche
