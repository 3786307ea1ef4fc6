#pragma once
// The only file that uses hypre. hypre's return codes are ignored and its error flag is cleared before and after each
// use: callers judge a preconditioner by the residual.
#include "linalg/core/grid_stencil.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Parameters of BoomerAMG, by hypre's numbers. The defaults are measured: docs/decisions/0002-preconditioner-choice.md.
struct AmgSettings {
  int coarsening = 10;                 // HMIS
  int interpolation = 6;               // extended+i
  int elements_per_row = 4;            // nonzeros in each row of the interpolation, at most
  int relax_down = 13, relax_up = 14;  // l1-scaled Gauss-Seidel, forward and backward: symmetric together
  int relax_coarsest = 8;  // l1-scaled symmetric Gauss-Seidel; direct elimination fails for singular systems
  double strength = 0.25;
  int aggressive_levels = 1;
  int sweeps = 1;  // before and after the coarse grid correction
  // For vector fields: the number of components, and the component (from 0) of each of this rank's rows. Each component
  // is coarsened and interpolated separately ("unknown-based" AMG).
  int components = 1;
  std::vector<int> component = {};
};

// One V(1,1) cycle of algebraic multigrid. Collective.
PreconditionerOrFailure make_boomeramg(const LinearSystem& system, const AmgSettings& settings = {});

struct PfmgSettings {
  int relax = 2;                 // red-black Gauss-Seidel, black-red after the coarse grid correction: symmetric
  int sweeps = 2;                // before and after the coarse grid correction
  int coarse_operator = 0;       // 0 Galerkin, 1 keeps the 5- or 7-point stencil
  int skip_relax = 1;            // on levels coarsened along one axis only
  double diagonal_shift = 1e-8;  // relative; avoids a zero diagonal on the coarsest grid of singular systems
};

// One V-cycle of geometric multigrid on the bounding box of the rows, cells without a row included. Fails if the matrix
// has no grid stencil. Collective.
PreconditionerOrFailure make_pfmg(const LinearSystem& system, const PfmgSettings& settings = {});

}  // namespace seiche
