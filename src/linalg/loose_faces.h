#pragma once
// Multigrid on faces, mended where it fails: on faces that no pressure row holds. Around a free surface they have next
// to no mass and only follow the stress, in pairs and chains across axes along which relaxation hardly moves.
#include "linalg/preconditioners.h"
#include "linalg/sparse_cholesky.h"

namespace seiche {

// z = B r with exact solves on the loose faces of this rank before and after: symmetric, and positive where B is and
// B F <= 2.
class LooseFaces : public Preconditioner {
 public:
  // `loose` by row of F, which it keeps a reference to. Collective.
  LooseFaces(const LinearSystem& F, const std::vector<char>& loose, std::unique_ptr<Preconditioner> B);
  void apply(const Vector& r, Vector& z) override;
  // Whether their matrix could be factored. Not collective.
  bool good() const { return good_; }

 private:
  void add_solved(const Vector& r, Vector& z) const;

  const LinearSystem& F_;
  std::unique_ptr<Preconditioner> B_;
  std::vector<int> rows_;
  SparseCholesky factor_;
  bool good_ = true;
};

}  // namespace seiche
