#pragma once
// Faces that no pressure row holds. Around a free surface they have next to no mass and only follow the stress, in
// pairs and chains across axes along which relaxation hardly moves.
#include "linalg/core/sparse_cholesky.h"
#include "linalg/precond/preconditioners.h"

namespace seiche {

// Exact solves with F on loose faces: chains within a rank by that rank, those that ranks share on all of them at once,
// so that results do not depend on where ranks cut.
class PressureFreeRows {
 public:
  // `loose` by row of F, which it keeps no reference to. Collective.
  PressureFreeRows(const LinearSystem& F, const std::vector<char>& pressure_free);
  // Whether their matrix could be factored, on all ranks.
  bool good() const { return good_; }
  // z_L += F_LL^-1 r_L. Collective.
  void add_solved(const Vector& r, Vector& z) const;

 private:
  void factor_shared(const LinearSystem& F, const Vector& flags);

  Communicator ranks_;
  std::vector<int> own_, shared_;                    // rows of this rank
  Eigen::Index shared_first_ = 0, shared_rows_ = 0;  // of all ranks'
  SparseCholesky own_factor_, shared_factor_;
  bool good_ = true;
};

// Multigrid on faces, mended where it fails: z = B r with exact solves on the loose faces before and after. Symmetric,
// and positive where B is and B F <= 2.
class PressureFreeFaces : public Preconditioner {
 public:
  // Keeps the references.
  PressureFreeFaces(const LinearSystem& F, const PressureFreeRows& pressure_free, std::unique_ptr<Preconditioner> B)
      : F_(F), pressure_free_(pressure_free), B_(std::move(B)) {}
  void apply(const Vector& r, Vector& z) override;

 private:
  const LinearSystem& F_;
  const PressureFreeRows& pressure_free_;
  std::unique_ptr<Preconditioner> B_;
};

}  // namespace seiche
