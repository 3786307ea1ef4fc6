#pragma once
// Chebyshev polynomial preconditioners. For matrices that the mass term keeps well conditioned they replace a multigrid
// cycle. They need no hierarchy and are the same operator on any number of ranks.
#include "linalg/core/sparse_vector.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Interval of the eigenvalues of D^-1 F, D = diag(F).
struct SpectralInterval {
  double low = 1, high = 1;
  double condition() const { return high / low; }
};

// `high` is an upper bound (Gershgorin). `low` is the Rayleigh quotient of a smooth vector, close to the lowest
// eigenvalue. 1 and 1 without unknowns. Collective.
SpectralInterval estimate_interval(const LinearSystem& F);

// Number of Chebyshev steps, from a zero guess, that reduce errors on the interval to the fraction `share`.
int chebyshev_steps(const SpectralInterval& interval, double share);

// z = B r by `steps` steps of the Chebyshev iteration for D^-1 F z = D^-1 r (Saad 2003, algorithm 12.1). B is
// symmetric, and positive with B F < 2 if no eigenvalue exceeds `high`; eigenvalues below `low` are allowed.
class Chebyshev : public Preconditioner {
 public:
  // Keeps a reference to F.
  Chebyshev(const LinearSystem& F, const SpectralInterval& interval, int steps);
  void apply(const Vector& r, Vector& z) override;

 private:
  const LinearSystem& F_;
  SpectralInterval interval_;
  int steps_;
  Vector inverse_, rest_, d_, Fd_;
};

// Applies Chebyshev::apply to each of `columns`, which are nonzero in few rows. Each step reaches one more neighbour;
// only reached rows are visited. Collective.
std::vector<SparseVector> solve_locally(const LinearSystem& F, const SpectralInterval& interval, int steps,
                                        const std::vector<Vector>& columns);

}  // namespace seiche
