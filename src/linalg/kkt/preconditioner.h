#pragma once
// Block diagonal: multigrid on A + c1 c2 J H^-1 J' (sparse approximation) and on H, motions of bodies as a whole
// exactly.
#include "linalg/kkt/operator.h"
#include "linalg/spd/schur_preconditioner.h"

namespace seiche {

class KktPreconditioner {
 public:
  // Keeps references. Collective.
  KktPreconditioner(const KktOperator& K, const BodyMatrix& H, const AmgSettings& settings);
  // Why it failed, else empty.
  const std::string& failure() const { return failure_; }
  // Collective.
  void apply(const Vector& r, Vector& z);

 private:
  std::vector<int> components() const;
  void find_motions(const SparseMatrix& H);
  void add_responses(const ColumnBlock& block, int first, int unknowns);
  void orthonormalise(int first, int width, std::size_t begin);

  const KktOperator& K_;
  std::unique_ptr<Preconditioner> B_;      // of H
  std::vector<Eigen::VectorXd> motions_;   // of rigid bodies the unknowns, of others responses to their loads
  Eigen::LDLT<Eigen::MatrixXd> energies_;  // of motions
  SchurPreconditioner schur_;
  std::string failure_;
};

}  // namespace seiche
