#include "coupling/solids/potential_sum.h"

#include <algorithm>

namespace seiche {

double PotentialSum::energy(const Eigen::VectorXd& v) const {
  double sum = 0;
  for (const auto& part : parts_) sum += part->energy(v);
  return sum;
}

void PotentialSum::add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const {
  for (const auto& part : parts_) part->add_gradient(v, gradient);
}

Eigen::SparseMatrix<double> PotentialSum::hessian(const Eigen::VectorXd& v, HessianProjection curvature,
                                                  IndexRange columns) const {
  Eigen::SparseMatrix<double> sum = parts_.front()->hessian(v, curvature, columns);
  for (std::size_t n = 1; n < parts_.size(); ++n) sum += parts_[n]->hessian(v, curvature, columns);
  return sum;
}

double PotentialSum::step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const {
  double bound = 1;
  for (const auto& part : parts_) bound = std::min(bound, part->step_bound(v, dv));
  return bound;
}

double PotentialSum::angle(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const {
  double largest = 0;
  for (const auto& part : parts_) largest = std::max(largest, part->angle(v, dv));
  return largest;
}

// Each part turns its own bodies.
void PotentialSum::turn(const Eigen::VectorXd& v, Eigen::VectorXd& dv) const {
  for (const auto& part : parts_) part->turn(v, dv);
}

double PotentialSum::round_off() const {
  double sum = 0;
  for (const auto& part : parts_) sum += part->round_off();
  return sum;
}

std::shared_ptr<const VelocityPotential> sum_of(PotentialSum::Parts parts) {
  if (parts.empty()) return nullptr;
  if (parts.size() == 1) return parts.front();
  return std::make_shared<PotentialSum>(std::move(parts));
}

}  // namespace seiche
