#pragma once
// S = A + c J H^-1 J': a sparse matrix and what few unknowns, eliminated, add to it (bodies behind a pressure matrix).
#include <Eigen/SparseCholesky>

#include "linalg/block_columns.h"
#include "linalg/linear_system.h"

namespace seiche {

using SmallMatrix = Eigen::SparseMatrix<double>;

// The null space with some of its components left out.
NullSpace without(NullSpace null_space, const std::vector<int>& components);

class CoupledSystem {
 public:
  // Keeps references. Collective.
  CoupledSystem(const LinearSystem& A, const BlockColumns& J, double c);

  // H, symmetric positive definite and the same on all ranks, for the products that follow. Empty: S = A.
  // Whether it could be factored.
  [[nodiscard]] bool set_small(const SmallMatrix& H);

  int rows() const { return A_.rows(); }
  const LinearSystem& liquid() const { return A_; }
  const Communicator& ranks() const { return A_.ranks(); }
  const BlockColumns& columns() const { return J_; }
  double scale() const { return c_; }
  bool is_coupled() const { return H_.rows() > 0; }
  const SmallMatrix& small() const { return H_; }

  // y = S x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  // r = b - S x. Collective.
  void residual(const Vector& b, const Vector& x, Vector& r) const;
  // Takes out of v the null space of S (of A, where S = A). Collective.
  void project(Vector& v) const;
  // c H^-1 w
  Eigen::VectorXd weigh(const Eigen::VectorXd& w) const;
  // Indicators of closed components whose constants S sees, since bodies feel them: null vectors of A only.
  const std::vector<int>& sensed_components() const { return sensed_; }

 private:
  void find_sensed();

  const LinearSystem& A_;
  const BlockColumns& J_;
  double c_;
  SmallMatrix H_;
  Eigen::SimplicialLDLT<SmallMatrix> factor_;
  std::vector<int> sensed_;          // numbers of components
  std::vector<double> sensed_rows_;  // of each of those, over all ranks
  Eigen::MatrixXd combinations_;     // columns: weights of the sensed components that no body feels together
  MeanRemover unsensed_means_;
};

}  // namespace seiche
