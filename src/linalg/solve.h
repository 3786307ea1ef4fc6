#pragma once
// Symmetric positive (semi-)definite systems: preconditioned conjugate gradients with a ladder of preconditioners.
#include <cstdint>
#include <string>
#include <vector>

#include "base/communicator.h"
#include "linalg/sparse_matrix.h"

namespace seiche {

struct SolveOptions {
  double tolerance = 1e-8;   // of |b - A x| / |b|, 2-norms, recomputed; bounds the divergence left in the flow
  int max_iterations = 400;  // of a rung with a hierarchy; rungs with "none" get ten times as many
  std::string preconditioner = "auto";
  int fail_rungs = 0;  // for tests: the first rungs of the ladder return a wrong x and claim success
};

struct SolveReport {
  bool converged = false;
  int iterations = 0;               // over all rungs tried
  double residual = 0;              // recomputed |b - A x| / |b|
  std::string used;                 // preconditioner of the last rung
  std::vector<std::string> ladder;  // one line a rung that failed
  std::int64_t identity_rows = 0;   // rows with a zero diagonal (cells with no open face): x = 0 there
  double mismatch = 0;              // |part of b no x can reach| / |b|: net inflow of closed components, for instance
};

// The names a scene may ask for.
std::vector<std::string> preconditioner_names();

// Solves A x = b from the initial x. b is made compatible per null-space component first (its mean removed), x keeps
// mean zero there. Tries the preconditioner asked for, then the rungs of the ladder; never returns a result whose
// recomputed residual was not checked. Throws Error(machine) for more rows than hypre can index.
[[nodiscard]] SolveReport solve_spd(const SparseMatrix& A, const RowGrid& grid, const NullSpace& null_space,
                                    const std::vector<double>& b, std::vector<double>& x, const SolveOptions& options,
                                    const Communicator& ranks);

}  // namespace seiche
