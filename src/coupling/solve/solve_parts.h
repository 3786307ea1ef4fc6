#pragma once
// Common parts of the inviscid, split and coupled solves of a step.
#include "coupling/solve/coupled_solve.h"
#include "coupling/solve/solids_minimum.h"

namespace seiche {

// Pressure matrix, its null space and its grid.
template <int Dim>
struct PressureProblem {
  NullSpace closed;
  DistributedMatrix A;
  RowGrid grid;

  PressureProblem() = default;
  PressureProblem(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows)
      : closed(find_closed_components(in, rows)), A(assemble_pressure_matrix(in, rows)), grid(row_grid(in, rows)) {}
};

// Throw Error(cannot_continue) if the prescribed volume changes of closed, full liquid do not balance. The first
// checks, before the solve, components whose mean pressure no body feels (those not in `sensed`). The second checks,
// after it, chambers closed off by bodies: single ones are no null vectors, but combinations may be.
// In components that no body feels, the first also gives pinned nodes the velocities of the step that ends: changes
// faces.cell_flux of the geometry, once a solve.
template <int Dim>
void refuse_impossible_motion(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                              const SolidCoupling<Dim>& coupling, const std::vector<int>& sensed,
                              const CoupledSolution<Dim>& r);
template <int Dim>
void refuse_unbalanced_chambers(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid,
                                const std::vector<int>& sensed, const CoupledSolution<Dim>& r);

// Relative residual of the solves for the liquid: the scene's tolerance. Beside bodies that deform it is a tenth of the
// accuracy of Newton's method (solid/contact/solve.cpp) at most: steps of the size of the solves' errors never end.
template <int Dim>
double liquid_tolerance(const CoupledInput<Dim>& input);

// First guess of the pressure, in the order of the rows.
template <int Dim>
Vector guessed_pressure(const CoupledInput<Dim>& input, const PressureRows<Dim>& rows);

// Minimises over the velocities of the bodies and returns them, with the rebounds that are due in coupling.push. Stores
// impacts, reactions, counts and report in r, and the missing fluxes of cavities in the geometry.
template <int Dim>
Eigen::VectorXd find_minimum(const CoupledInput<Dim>& input, SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                             const InviscidLiquid<Dim>& inviscid, CoupledSolution<Dim>& r);

// Copies p into r.pressure and fills its ghosts.
template <int Dim>
void set_pressure(const CoupledInput<Dim>& input, const Vector& p, CoupledSolution<Dim>& r);

}  // namespace seiche
