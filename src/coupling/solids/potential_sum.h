#pragma once
// Sum of the potentials of participants and interactions.
#include <memory>
#include <vector>

#include "solid/energy/velocity_potential.h"

namespace seiche {

class PotentialSum : public VelocityPotential {
 public:
  using Parts = std::vector<std::shared_ptr<const VelocityPotential>>;
  // At least one part.
  explicit PotentialSum(Parts parts) : parts_(std::move(parts)) {}
  double energy(const Eigen::VectorXd& v) const override;
  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override;
  Eigen::SparseMatrix<double> hessian(const Eigen::VectorXd& v, HessianProjection curvature,
                                      IndexRange columns) const override;
  double step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const override;
  double angle(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const override;
  void turn(const Eigen::VectorXd& v, Eigen::VectorXd& dv) const override;
  double round_off() const override;

 private:
  Parts parts_;
};

// Null for no parts; a single part is returned itself.
std::shared_ptr<const VelocityPotential> sum_of(PotentialSum::Parts parts);

}  // namespace seiche
