#pragma once
// Pressure-free faces: faces that no pressure row touches. Near a free surface they have almost no mass and are coupled
// through the stress in pairs and chains across axes; relaxation hardly reduces their errors.
#include "linalg/core/sparse_cholesky.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Exact solves with F on the pressure-free faces. Chains within a rank are factored by that rank. Chains across ranks
// are gathered and factored on every rank, so that results do not depend on the partition.
class PressureFreeRows {
 public:
  // `loose`: one flag a row of F. Keeps no reference to F. Collective.
  PressureFreeRows(const LinearSystem& F, const std::vector<char>& pressure_free);
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
class PressureFreeFaces : public Preconditioner {
 public:
  // Keeps references to F and `loose`.
  PressureFreeFaces(const LinearSystem& F, const PressureFreeRows& pressure_free, std::unique_ptr<Preconditioner> B)
      : F_(F), pressure_free_(pressure_free), B_(std::move(B)) {}
  void apply(const Vector& r, Vector& z) override;

 private:
  const LinearSystem& F_;
  const PressureFreeRows& pressure_free_;
  std::unique_ptr<Preconditioner> B_;
};

}  // namespace seiche
