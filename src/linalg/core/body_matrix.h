#pragma once
// The matrix behind bodies (inertia, stiffness, contact) with its Cholesky factors, bodies that do not touch apart.
#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>

#include "base/communicator.h"
#include "linalg/core/sparse_cholesky.h"

namespace seiche {

// Connected parts of more than `shared_limit` unknowns are factored each on one rank, the largest first on the rank
// that has least to do; the others together, on every rank.
class BodyMatrix {
 public:
  static constexpr int shared_limit = 1000;

  explicit BodyMatrix(const Communicator& ranks) : ranks_(ranks) {}

  // H is the same on all ranks. Whether it is positive definite. Patterns that stay keep their ordering. Collective.
  [[nodiscard]] bool set(SparseMatrix H);
  // H without factors: for its products and its size alone.
  void keep(SparseMatrix H) { H_ = std::move(H); }
  const SparseMatrix& matrix() const { return H_; }
  int size() const { return int(H_.rows()); }
  // H^-1 b, the same bits on all ranks. Collective.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Part {
    std::vector<int> rows;  // ascending
    int owner = 0;
    SparseCholesky factor;
  };
  void find_parts();
  void share_out();
  SparseMatrix submatrix(const std::vector<int>& rows) const;
  bool factor_shared();

  Communicator ranks_;
  SparseMatrix H_;
  std::vector<int> shared_;  // rows of the small parts
  Eigen::SimplicialLDLT<SparseMatrix> shared_factor_;
  std::vector<Part> parts_;
};

}  // namespace seiche
