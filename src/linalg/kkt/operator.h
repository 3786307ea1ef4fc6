#pragma once
// [A, c1 J; c1 J', -(c1/c2) H] over the ranks: vectors are this rank's rows of A, then its share of the bodies'
// unknowns.
#include "linalg/kkt/solver.h"

namespace seiche {

class KktOperator {
 public:
  // Keeps references. Collective.
  KktOperator(const KktSystem& system, const LinearSystem& A, const SparseMatrix& H);

  const LinearSystem& liquid() const { return A_; }
  const LinearSystem& solid() const { return *H_; }  // this rank's rows of H
  const KktSystem& system() const { return system_; }
  int pressures() const { return A_.rows(); }
  int first_unknown() const { return int(rows_.first_row); }

  Vector pack(const Vector& p, const Eigen::VectorXd& v) const;
  // v on all ranks. Collective.
  void unpack(const Vector& x, Vector& p, Eigen::VectorXd& v) const;
  // Collective.
  void multiply(const Vector& x, Vector& y) const;
  void residual(const Vector& b, const Vector& x, Vector& r) const;
  // Whether a product has met v'H v < 0.
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
