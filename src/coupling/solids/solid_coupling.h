#pragma once
// Coupling of the liquid and the solids with unknowns through the faces that the bodies close.
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

template <int Dim>
class JointMotion;

// The unknowns v are the velocities of the participants over the horizon, stacked in the order of the scene. Without
// liquid the energy of their inertia is e(v) = 1/2 v'Mv - v'push.
template <int Dim>
struct SolidCoupling {
  std::vector<int> bodies;    // index in the scene of each solid with unknowns, one a block
  std::vector<int> first{0};  // first unknown of each block; last: the number of unknowns
  // (J v)_c = sum_f +- s_f v(x_f).e_f: flux out of cell c by the bodies' motion, per face area. A_f J'p is the load of
  // the pressure p on each unknown. Columns of fixed unknowns are zero.
  BlockColumns J;
  BlockColumns J_held;   // columns of J of pinned nodes alone
  SparseMatrix mass;     // M; elastic bodies: dt H (M/gamma^2 + C/gamma), see IncrementalPotential
  Eigen::VectorXd push;  // M v*, v* the velocities without liquid, contact and elastic forces
  Eigen::VectorXd free;  // without liquid and contact; elastic bodies: v + dt g, a scale and first guess
  // v* of rigid bodies, with the buoyancy correction; else 0.
  Eigen::VectorXd target;
  // Loads that face shares miss: wet bodies feel exactly rho g times their volume, floating ones the linear pressure on
  // their wet surface. Rigid bodies: force and torque (N, N m). Elastic bodies: nodal forces (N), which for thin ones
  // are the weight of the liquid beside them. Else 0.
  Eigen::VectorXd buoyancy_correction;
  // Mass (kg) and momentum before the step (kg m/s) of liquid that moves with thin elastic bodies (liquid_beside.h).
  // Both are part of `mass` and `push`.
  Eigen::VectorXd mass_beside, momentum_beside;
  std::vector<Freedom> freedom;
  Eigen::VectorXd held;                                // prescribed velocities of fixed unknowns; else 0
  std::shared_ptr<const VelocityPotential> potential;  // null: none
  std::vector<CavityConstraint<Dim>> cavities;
  std::shared_ptr<JointMotion<Dim>> joints;                    // with the right-hand side of J.constraints; null: none
  std::vector<std::shared_ptr<const CellFluxes>> cell_fluxes;  // one a block: fluxes beyond those of the face shares

  int size() const { return first.back(); }
  bool is_constrained() const { return J.constraints.rows() > 0; }
  bool is_held(Eigen::Index i) const { return freedom[std::size_t(i)] == Freedom::fixed; }
  bool any_held() const { return std::find(freedom.begin(), freedom.end(), Freedom::fixed) != freedom.end(); }
};

// Contributions to a coupling while they are gathered.
template <int Dim>
struct CouplingParts {
  SolidCoupling<Dim>& coupling;
  std::vector<Eigen::Triplet<double>> mass = {};
  std::vector<double> sums = {};          // summed over the ranks, see Participant::couple
  std::vector<BodyEntries> entries = {};  // columns that interactions may correct
  std::vector<std::shared_ptr<const VelocityPotential>> potentials = {};
  std::optional<CellField<Dim, char>> open = {};  // open_cells(), once computed
  Eigen::VectorXd missing = {};  // loads to be added to buoyancy_correction, this rank's part; empty: none
};

// Gathers the coupling for one solve. Collective.
template <int Dim>
SolidCoupling<Dim> couple_solids(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry,
                                 const PressureRows<Dim>& rows, const NullSpace& closed, const State<Dim>& state,
                                 double dt, double horizon);

// Gives the bodies the solved velocities v over the horizon, in state and geometry.
template <int Dim>
void set_velocities(const Domain<Dim>& domain, const Solids<Dim>& solids, const SolidCoupling<Dim>& coupling,
                    const Eigen::VectorXd& v, double horizon, StepGeometry<Dim>& geometry, State<Dim>& state);

// Gives the bodies the forces that hold their fixed unknowns. `reactions`: N, one an unknown; 0 for free ones.
template <int Dim>
void set_reactions(const SolidCoupling<Dim>& coupling, const Eigen::VectorXd& reactions, State<Dim>& state);

// Puts the velocities of pinned nodes and the fluxes beyond the face shares into the geometry before the solve: they
// move the liquid whatever the solution is.
template <int Dim>
void set_held_velocities(const Domain<Dim>& domain, const SolidCoupling<Dim>& coupling, StepGeometry<Dim>& geometry);

// Velocities of the unknowns as the state has them, stacked: before the solve, then those found.
template <int Dim>
Eigen::VectorXd velocities_in(const SolidCoupling<Dim>& coupling, const State<Dim>& state);

// Velocities of the unknowns over a coming step of dt: those of the last solve, corrected for the constraints of
// interactions. One vector a participant; then all stacked.
template <int Dim>
std::vector<Eigen::VectorXd> each_velocity_over(const Solids<Dim>& solids, const State<Dim>& state, double dt);
template <int Dim>
Eigen::VectorXd velocities_over(const Solids<Dim>& solids, const State<Dim>& state, double dt);

}  // namespace seiche
