#pragma once
// Polynomial preconditioners: for matrices that mass keeps well conditioned they do what a multigrid cycle does,
// without a hierarchy to build, and the same on any number of ranks.
#include "linalg/core/sparse_vector.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Where the eigenvalues of D^-1 F lie, D the diagonal of F.
struct SpectralInterval {
  double low = 1, high = 1;
  double condition() const { return high / low; }
};

// `high` bounds them (Gershgorin); `low` is the Rayleigh quotient of a smooth vector, near the lowest. Collective.
SpectralInterval estimate_interval(const LinearSystem& F);

// Steps of Chebyshev's iteration from zero that leave `share` of an error on the interval.
int chebyshev_steps(const SpectralInterval& interval, double share);

// z = B r by `steps` steps of Chebyshev's iteration for D^-1 F z = D^-1 r (Saad 2003, algorithm 12.1). Symmetric, and
// positive with B F < 2 as long as no eigenvalue is above `high`, wherever the lowest are.
class Chebyshev : public Preconditioner {
 public:
  // Keeps the reference to F.
  Chebyshev(const LinearSystem& F, const SpectralInterval& interval, int steps);
  void apply(const Vector& r, Vector& z) override;

 private:
  const LinearSystem& F_;
  SpectralInterval interval_;
  int steps_;
  Vector inverse_, rest_, d_, Fd_;
};

// As Chebyshev::apply to each of `columns`, which differ from zero in few rows: a step reaches one neighbour further,
// and only rows that are reached are visited. Collective.
std::vector<SparseVector> solve_locally(const LinearSystem& F, const SpectralInterval& interval, int steps,
                                        const std::vector<Vector>& columns);

}  // namespace seiche
