#include "solid/energy/rigid_problem.h"

#include "linalg/core/sparse_ldlt.h"

namespace seiche {

InertiaProblem::~InertiaProblem() = default;

bool InertiaProblem::holds(const Eigen::VectorXd&) const {
  return true;
}

DryProblem::DryProblem(Eigen::SparseMatrix<double> mass, Eigen::VectorXd target, std::vector<Freedom> freedom,
                       Eigen::VectorXd held)
    : target_(std::move(target)), freedom_(std::move(freedom)), held_(std::move(held)) {
  mass_.swap(mass);  // Eigen 3.4 would copy where it should move
  freedom_.resize(target_.size(), Freedom::free);
  if (held_.size() == 0) held_.setZero(target_.size());
  for (int i = 0; i < size(); ++i)
    if (freedom_[i] == Freedom::free) held_[i] = 0;
}

bool DryProblem::holds(const Eigen::VectorXd& v) const {
  for (int i = 0; i < size(); ++i)
    if (freedom_[i] == Freedom::fixed && v[i] != held_[i]) return false;
  return true;
}

// (M + K) v = M v* + r at free degrees of freedom, v = v_held at fixed ones.
InertiaResponse DryProblem::minimise(const Eigen::SparseMatrix<double>& K, const Eigen::VectorXd& r) {
  if (target_.size() == 0) return respond(target_);
  Eigen::SparseMatrix<double> matrix = mass_ + K;
  Eigen::VectorXd rhs = mass_ * target_ + r;
  if (!held_.isZero(0)) rhs -= matrix * held_;
  matrix.prune([&](auto row, auto column, double) {
    return row == column || (freedom_[row] == Freedom::free && freedom_[column] == Freedom::free);
  });
  for (int i = 0; i < size(); ++i) {
    if (freedom_[i] == Freedom::free) continue;
    matrix.coeffRef(i, i) = 1;
    rhs[i] = held_[i];
  }
  SparseLdlt factor;
  if (!factor.factor(matrix) || !factor.is_positive()) return {"", Shape::indefinite, {}, {}};
  return respond(factor.solve(rhs));
}

InertiaResponse DryProblem::respond(const Eigen::VectorXd& v) {
  return {"", Shape::convex, v, mass_ * (v - target_)};
}

}  // namespace seiche
