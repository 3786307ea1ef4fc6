#pragma once
// The one solve of a step: liquid pressure, rigid bodies, contact.
#include "coupling/rigid_coupling.h"

namespace seiche {

template <int Dim>
struct CoupledSolution {
  PressureRows<Dim> rows;
  CellField<Dim> pressure;
  std::vector<int> closed_component;  // of each row: a number where no pressure is given, else -1; empty: -1 everywhere
  SolveReport report;                 // iterations of all solves, the worst residual
  int newton_iterations = 0, contacts = 0;
  std::string failure;  // empty: accepted
};

// The pressure that leaves no liquid cell with a net flux, and the velocities of the rigid and elastic bodies that go
// with it, which are set in the geometry and the states. `guess` is the first guess of the pressure. Throws
// Error(cannot_continue) where the solids prescribe what closed liquid cannot do.
template <int Dim>
CoupledSolution<Dim> solve_coupled(const Setup<Dim>& setup, const ProjectionInput<Dim>& in, StepGeometry<Dim>& geometry,
                                   State<Dim>& state, const CellField<Dim>& guess, const FaceField<Dim>& u_star,
                                   double horizon, PhaseFault fault);

}  // namespace seiche
