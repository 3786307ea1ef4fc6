#pragma once
// Block-diagonal preconditioner: multigrid on the Schur complement A + c1 c2 J H^-1 J' (H^-1 approximated by a sparse
// matrix) and multigrid on H with exact deflation of a few motions of each body.
#include "linalg/core/dense_factors.h"
#include "linalg/kkt/operator.h"
#include "linalg/spd/schur_preconditioner.h"

namespace seiche {

class KktPreconditioner {
 public:
  // Unit vectors of rigid unknowns, and responses of deformable bodies to a few loads. They need only span the soft
  // directions of H, so those of an earlier H will do.
  using Motions = std::vector<Eigen::VectorXd>;

  // Keeps references. Finds `motions` if they are empty. Collective.
  KktPreconditioner(const KktOperator& K, const BodyMatrix& H, const AmgSettings& settings, Motions& motions);
  // Reason why the set-up failed; empty if it succeeded.
  const std::string& failure() const { return failure_; }
  // True if a motion with m'H m <= 0 was met: H is not positive definite.
  bool met_indefinite() const { return indefinite_; }
  // Collective.
  void apply(const Vector& r, Vector& z);

 private:
  std::vector<int> components() const;
  void find_motions(int unknowns);
  void add_responses(const ColumnBlock& block, int first, int unknowns);
  void orthonormalise(int first, int width, std::size_t begin);

  const KktOperator& K_;
  std::unique_ptr<Preconditioner> B_;  // for H
  Motions& motions_;
  DenseLdlt energies_;  // M'H M, M = motions_
  SchurPreconditioner schur_;
  std::string failure_;
  bool indefinite_ = false;
};

}  // namespace seiche
