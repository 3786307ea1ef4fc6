#pragma once
// The only file that sees hypre. Its return codes and its error flag are cleared before and ignored after each use:
// whoever uses a preconditioner from here judges by the residual.
#include "linalg/core/grid_stencil.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// BoomerAMG's choices, by hypre's numbers. The defaults are measured: docs/decisions/0002-preconditioner-choice.md.
struct AmgSettings {
  int coarsening = 10;                 // HMIS
  int interpolation = 6;               // extended+i
  int elements_per_row = 4;            // of the interpolation
  int relax_down = 13, relax_up = 14;  // l1-scaled Gauss-Seidel, forward and backward: symmetric together
  int relax_coarsest = 8;              // l1-scaled symmetric Gauss-Seidel; elimination fails on singular systems
  double strength = 0.25;
  int aggressive_levels = 1;
  int sweeps = 1;  // before and after the coarse grid
  // Of systems of vector fields: the component, from 0, of each of this rank's rows, and how many there are. Components
  // are coarsened and interpolated each by itself ("unknown-based").
  int components = 1;
  std::vector<int> component = {};
};

// One V(1,1) cycle of algebraic multigrid. Collective.
PreconditionerOrFailure make_boomeramg(const LinearSystem& system, const AmgSettings& settings = {});

struct PfmgSettings {
  int relax = 2;                 // red-black Gauss-Seidel, black-red after the coarse grid: symmetric
  int sweeps = 2;                // before and after the coarse grid
  int coarse_operator = 0;       // 0 Galerkin, 1 keeps the 5- or 7-point stencil
  int skip_relax = 1;            // on levels coarsened along one axis only
  double diagonal_shift = 1e-8;  // relative, where a null space would leave a zero on the coarsest grid
};

// One V-cycle of geometric multigrid on the box of the grid, cells without a row included. Collective.
PreconditionerOrFailure make_pfmg(const LinearSystem& system, const PfmgSettings& settings = {});

}  // namespace seiche
