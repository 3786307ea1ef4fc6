#pragma once
// K = [A, c1 J; c1 J', -(c1/c2) H], distributed. Vectors hold this rank's rows of A, then its share of the bodies'
// unknowns.
#include "linalg/kkt/solver.h"

namespace seiche {

class KktOperator {
 public:
  // Keeps references, but not to H. H is shared out (linalg/core/shared_columns.h). Collective.
  KktOperator(const KktSystem& system, const LinearSystem& A, const SparseMatrix& H);

  const LinearSystem& liquid() const { return A_; }
  const LinearSystem& solid() const { return *H_; }  // H by rows
  const KktSystem& system() const { return system_; }
  int pressures() const { return A_.rows(); }
  int first_unknown() const { return int(rows_.first_row); }

  Vector pack(const Vector& p, const Eigen::VectorXd& v) const;
  // Gives v in full on all ranks. Collective.
  void unpack(const Vector& x, Vector& p, Eigen::VectorXd& v) const;
  // y = K x and r = b - K x. Collective.
  void multiply(const Vector& x, Vector& y) const;
  void residual(const Vector& b, const Vector& x, Vector& r) const;
  // True if some product met v'H v < 0.
  bool met_indefinite() const { return indefinite_; }

 private:
  const KktSystem& system_;
  const LinearSystem& A_;
  DistributedMatrix rows_;
  RowGrid no_grid_;
  NullSpace none_;
  std::unique_ptr<LinearSystem> H_;
  mutable bool indefinite_ = false;
};

}  // namespace seiche
