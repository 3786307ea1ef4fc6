#pragma once
// Geometric multigrid of our own on the box around the rows: one V-cycle in single precision.
#include "linalg/precond/preconditioners.h"

namespace seiche {

struct MultigridSettings {
  int sweeps = 2;                       // red-black Gauss-Seidel before and after the coarse grid
  std::int64_t gathered_cells = 16384;  // levels with no more cells are held whole by every rank
  std::int64_t coarsest_cells = 64;     // solved exactly
};

// For matrices whose rows couple neighbouring cells. Collective. docs/decisions/0032-geometric-multigrid.md
PreconditionerOrFailure make_geometric_multigrid(const LinearSystem& system, const MultigridSettings& settings = {});

}  // namespace seiche
