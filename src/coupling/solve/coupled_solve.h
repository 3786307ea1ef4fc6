#pragma once
// The one solve of a step: pressure and viscosity of the liquid, rigid and elastic bodies, contact.
#include "coupling/solve/viscous_coupling.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

template <int Dim>
struct CoupledInput {
  const Setup<Dim>& setup;
  const ProjectionInput<Dim>& liquid;
  StepGeometry<Dim>& geometry;  // takes the solids' velocities
  State<Dim>& state;            // likewise
  const CellField<Dim>& guess;  // of the pressure
  const FaceField<Dim>& slope;  // grad p/rho of the step before, where known
  const FaceField<Dim>& flow;   // velocities as the step began
  const FaceField<Dim>& u_star;
  double horizon;
  const ViscosityField<Dim>* viscosity;  // null: inviscid
  PhaseFault fault;
};

template <int Dim>
struct CoupledSolution {
  PressureRows<Dim> rows;
  CellField<Dim> pressure;
  FaceField<Dim> u_star;              // with what viscosity adds: u = u_star - dt grad p/rho
  std::vector<int> closed_component;  // of each row: a number where no pressure is given, else -1; empty: -1 everywhere
  SolveReport report;                 // iterations of all solves, the worst residual
  int newton_iterations = 0, contacts = 0;
  Eigen::VectorXd solids;                  // velocities of the bodies' unknowns
  Eigen::VectorXd reactions;               // N: the forces that hold them, zero where they are free
  std::vector<ViscousLoad> viscous_loads;  // of each solid; empty where the liquid is inviscid
  double dissipation = 0;                  // by viscosity, W
  double separation_error = 0;             // SeparationSearch::error
  std::string failure;                     // empty: accepted
};

// The pressure that leaves no liquid cell with a net flux, and the velocities of the rigid and elastic bodies that go
// with it, which are set in the geometry and the states. Throws Error(cannot_continue) where the solids prescribe what
// closed liquid cannot do.
template <int Dim>
CoupledSolution<Dim> solve_coupled(const CoupledInput<Dim>& input);

}  // namespace seiche
