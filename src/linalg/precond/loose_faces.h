#pragma once
// Pressure-free faces: faces that no pressure row touches. Near a free surface they have almost no mass and are coupled
// through the stress in pairs and chains across axes; relaxation hardly reduces their errors.
#include "linalg/core/sparse_cholesky.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Exact solves with F on the pressure-free faces. Chains within a rank are factored by that rank. Chains across ranks
// are gathered and factored on every rank, so that results do not depend on the partition.
class LooseRows {
 public:
  // `loose`: one flag a row of F. Keeps no reference to F. Collective.
  LooseRows(const LinearSystem& F, const std::vector<char>& loose);
  // True if the factorizations succeeded on all ranks.
  bool good() const { return good_; }
  // z_L += F_LL^-1 r_L. Collective.
  void add_solved(const Vector& r, Vector& z) const;

 private:
  void factor_shared(const LinearSystem& F, const Vector& flags);

  Communicator ranks_;
  std::vector<int> own_, shared_;                    // local rows
  Eigen::Index shared_first_ = 0, shared_rows_ = 0;  // position of this rank's rows in shared_factor_, and their total
  SparseCholesky own_factor_, shared_factor_;
  bool good_ = true;
};

// Face multigrid B with exact solves on the pressure-free faces before and after. Symmetric; positive if B is and B F
// <= 2.
class LooseFaces : public Preconditioner {
 public:
  // Keeps references to F and `loose`.
  LooseFaces(const LinearSystem& F, const LooseRows& loose, std::unique_ptr<Preconditioner> B)
      : F_(F), loose_(loose), B_(std::move(B)) {}
  void apply(const Vector& r, Vector& z) override;

 private:
  const LinearSystem& F_;
  const LooseRows& loose_;
  std::unique_ptr<Preconditioner> B_;
};

}  // namespace seiche
