#pragma once
// S = A + c J H^-1 J': a sparse matrix and what few unknowns, eliminated, add to it (bodies behind a pressure matrix).
#include "linalg/core/block_columns.h"
#include "linalg/core/body_matrix.h"
#include "linalg/core/linear_system.h"

namespace seiche {

// The null space with some of its components left out.
NullSpace without(NullSpace null_space, const std::vector<int>& components);

class CoupledSystem {
 public:
  // Keeps references. Collective.
  CoupledSystem(const LinearSystem& A, const BlockColumns& J, double c);

  // H for the products that follow; kept by reference. Empty: S = A.
  void set_bodies(const BodyMatrix& H) { H_ = &H; }

  int rows() const { return A_.rows(); }
  const LinearSystem& liquid() const { return A_; }
  const Communicator& ranks() const { return A_.ranks(); }
  const BlockColumns& columns() const { return J_; }
  double scale() const { return c_; }
  bool is_coupled() const { return H_ && H_->size() > 0; }
  const SparseMatrix& bodies() const { return H_->matrix(); }  // where it is coupled

  // y = S x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  // r = b - S x. Collective.
  void residual(const Vector& b, const Vector& x, Vector& r) const;
  // Takes out of v the null space of S (of A, where S = A). Collective.
  void project(Vector& v) const;
  // c H^-1 w. Collective.
  Eigen::VectorXd weigh(const Eigen::VectorXd& w) const;
  // Indicators of closed components whose constants S sees, since bodies feel them: null vectors of A only.
  const std::vector<int>& sensed_components() const { return sensed_; }

 private:
  void find_sensed();

  const LinearSystem& A_;
  const BlockColumns& J_;
  double c_;
  const BodyMatrix* H_ = nullptr;
  std::vector<int> sensed_;          // numbers of components
  std::vector<double> sensed_rows_;  // of each of those, over all ranks
  Eigen::MatrixXd combinations_;     // columns: weights of the sensed components that no body feels together
  MeanRemover unsensed_means_;
};

}  // namespace seiche
