#pragma once
// S = A + c J H^-1 J': a sparse matrix A (pressure) and the Schur complement of a few eliminated unknowns (bodies).
#include "linalg/core/block_columns.h"
#include "linalg/core/body_matrix.h"
#include "linalg/core/linear_system.h"

namespace seiche {

// The null space without the given components.
NullSpace without(NullSpace null_space, const std::vector<int>& components);

class CoupledSystem {
 public:
  // Keeps references. Collective.
  CoupledSystem(const LinearSystem& A, const BlockColumns& J, double c);

  // Sets H for subsequent products; kept by reference. An empty H means S = A.
  void set_bodies(const BodyMatrix& H) { H_ = &H; }

  int rows() const { return A_.rows(); }
  const LinearSystem& liquid() const { return A_; }
  const Communicator& ranks() const { return A_.ranks(); }
  const BlockColumns& columns() const { return J_; }
  double scale() const { return c_; }
  bool is_coupled() const { return H_ && H_->size() > 0; }
  const BodyMatrix& bodies() const { return *H_; }  // only if is_coupled()

  // y = S x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  // r = b - S x. Collective.
  void residual(const Vector& b, const Vector& x, Vector& r) const;
  // Projects v onto the range of S, orthogonal to its null space (of A if S = A). Collective.
  void project(Vector& v) const;
  // Returns c H^-1 w. Collective.
  Eigen::VectorXd weigh(const Eigen::VectorXd& w) const;
  // Returns c H^-1 W, all columns at once. Collective.
  Eigen::MatrixXd weigh_columns(const Eigen::MatrixXd& W) const;
  // Closed components that bodies feel (J' chi != 0, constraints aside): their indicators chi are null vectors of A but
  // not of S.
  const std::vector<int>& sensed_components() const { return sensed_; }

 private:
  void find_sensed();

  const LinearSystem& A_;
  const BlockColumns& J_;
  double c_;
  const BodyMatrix* H_ = nullptr;
  std::vector<int> sensed_;          // component numbers
  std::vector<double> sensed_rows_;  // their numbers of rows, over all ranks
  Eigen::MatrixXd combinations_;     // columns: combinations of the sensed components that no body feels
  MeanRemover unsensed_means_;
};

}  // namespace seiche
