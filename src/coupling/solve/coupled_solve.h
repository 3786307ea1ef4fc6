#pragma once
// Coupled solve of a step: pressure and viscosity of the liquid, rigid and elastic bodies, contact.
#include "coupling/solids/convected_pressure.h"
#include "coupling/solve/flow_at_walls.h"
#include "coupling/solve/viscous_coupling.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
struct CoupledInput {
  const Setup<Dim>& setup;
  const ProjectionInput<Dim>& liquid;
  StepGeometry<Dim>& geometry;  // receives the solids' velocities
  State<Dim>& state;            // likewise
  const CellField<Dim>& guess;  // first guess of the pressure
  const FaceField<Dim>& slope;  // grad p/rho of the step before, where known
  const FaceField<Dim>& flow;   // velocities at the start of the step
  const FaceField<Dim>& u_star;
  const ConvectedPressure<Dim>& convected;
  const PagedFaceField<Dim>* flux_of_end;  // EndOfStep::flux; null: none
  double horizon;
  const ViscosityField<Dim>* viscosity;  // null: inviscid
  PhaseFault fault;
  const FlowAtWalls<Dim>* at_walls = nullptr;  // null: flow and motions at the start of the step
  // Velocities of the bodies' unknowns in an earlier solve over this horizon; null or empty: none.
  const Eigen::VectorXd* solids = nullptr;
  // Cells separated from walls in an earlier solve of this step; null or empty: none.
  const CellField<Dim, char>* separated = nullptr;
  const KnownLoads* known_loads = nullptr;  // null: none
};

template <int Dim>
struct CoupledSolution {
  PressureRows<Dim> rows;
  CellField<Dim> pressure;
  FaceField<Dim> u_star;              // viscosity included: u = u_star - dt grad p/rho
  std::vector<int> closed_component;  // one a row: its closed component; -1: pressure is given; empty: -1 everywhere
  SolveReport report;                 // iterations of all solves, the worst residual
  int newton_iterations = 0, contacts = 0, joint_turns = 0;
  bool friction_settled = true;          // ContactReport::friction
  Eigen::VectorXd solids;                // velocities of the bodies' unknowns
  Impacts impacts;                       // State::impacts after the solve
  Eigen::VectorXd reactions;             // N: constraint forces on the unknowns, 0 for free ones
  std::vector<SolidLoad> viscous_loads;  // one a solid; empty: inviscid liquid
  ViscousPower viscous;                  // of viscous stress
  double contact_power = 0;              // of prescribed solids on those that they touch, W
  double separation_error = 0;           // SeparationSearch::error
  std::string failure;                   // empty: accepted
};

// Solves for the pressure with which no liquid cell has a net flux, and for the velocities of rigid and elastic bodies.
// Sets these in the geometry and the state. Throws Error(cannot_continue) if the solids prescribe a motion that closed
// liquid cannot follow. Collective.
template <int Dim>
CoupledSolution<Dim> solve_coupled(const CoupledInput<Dim>& input);

}  // namespace seiche
