#pragma once
// Pressures and bodies at once, for bodies too large to factor:
//   A p + c1 J v    = b
//   H v  - c2 J'p   = g
// What SpdSolver solves with H eliminated, by MINRES on [A, c1 J; c1 J', -(c1/c2) H] with multigrid on both blocks.
#include <memory>

#include "linalg/saddle/solver.h"

namespace seiche {

struct KktSystem {
  const DistributedMatrix& A;
  const RowGrid& grid;
  const NullSpace& closed;  // of A
  const BlockColumns& J;
  double c1, c2;  // positive
  int dimension;  // axes of a node: unknown k of a block that deforms is its velocity along axis k % dimension
};

struct KktReport {
  SaddleReport solve;       // momentum: of the second row; continuity: of the first
  bool indefinite = false;  // v'H v < 0 was met: then nothing was solved
};

class KktOperator;
class KktPreconditioner;

class KktSolver {
 public:
  // Keeps references to what `system` refers to. Collective.
  KktSolver(const KktSystem& system, const SaddleOptions& options, const Communicator& ranks);
  ~KktSolver();

  // From the initial p and v. H, the same on all ranks, should be positive definite, v'H v < 0 is reported where it is
  // met. The tolerance of continuity is relative to `scale`, or to |b| where that is 0; that of momentum, in the norm
  // of diag(H)^-1, to g and c2 J'p, or to the rounding of H v. Collective.
  [[nodiscard]] KktReport solve(const SparseMatrix& H, const Vector& b, const Eigen::VectorXd& g, Vector& p,
                                Eigen::VectorXd& v, double scale = 0);

 private:
  struct Problem;
  struct Residual {
    double momentum, continuity;
  };
  Problem pose(const Vector& b, const Eigen::VectorXd& g, double scale, SaddleReport& report) const;
  Residual measure(const Problem& problem, const Vector& x) const;
  std::string attempt(const std::string& strength, const Problem& problem, Vector& x, SaddleReport& report);

  KktSystem system_;
  SaddleOptions options_;
  Communicator ranks_;
  LinearSystem A_;
  CoupledSystem coupled_;
  BodyMatrix bodies_;
  std::unique_ptr<KktOperator> K_;
};

}  // namespace seiche
