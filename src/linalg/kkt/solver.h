#pragma once
// Monolithic solve for pressures and bodies that are too large to factor:
//   A p + c1 J v    = b
//   H v  - c2 J'p   = g
// SpdSolver solves the same system with v eliminated. Here: MINRES on [A, c1 J; c1 J', -(c1/c2) H] with multigrid on
// both blocks.
#include <memory>

#include "linalg/saddle/solver.h"

namespace seiche {

struct KktSystem {
  const DistributedMatrix& A;
  const RowGrid& grid;
  const NullSpace& closed;  // of A
  const BlockColumns& J;
  double c1, c2;  // positive
  int dimension;  // unknown k of a deformable block is the velocity of a node along axis k % dimension
};

struct KktReport {
  SaddleReport solve;       // momentum is the second row, continuity the first
  bool indefinite = false;  // v'H v < 0 was met; p and v are then no solution
};

class KktOperator;
class KktPreconditioner;

class KktSolver {
 public:
  // Keeps references to the members of `system`. Collective.
  KktSolver(const KktSystem& system, const SaddleOptions& options, const Communicator& ranks);
  ~KktSolver();

  // Solves from the initial p and v. H is shared out (linalg/core/shared_columns.h) and should be positive definite;
  // v'H v < 0 is reported if it is met. The continuity residual is relative to `scale`, or to |b| if `scale` is 0. The
  // momentum residual is measured in the norm of diag(H)^-1, relative to |g| + |c2 J'p| or to the round-off of H v.
  // Collective.
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
  std::vector<Eigen::VectorXd> motions_;  // KktPreconditioner::Motions, once found
  bool indefinite_ = false;               // KktPreconditioner::met_indefinite() in this solve
};

}  // namespace seiche
