#pragma once
// Energies of several participants and interactions as one.
#include <memory>

#include "solid/energy/velocity_potential.h"

namespace seiche {

class PotentialSum : public VelocityPotential {
 public:
  using Parts = std::vector<std::shared_ptr<const VelocityPotential>>;
  explicit PotentialSum(Parts parts) : parts_(std::move(parts)) {}
  double energy(const Eigen::VectorXd& v) const override;
  void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const override;
  void add_terms(const Eigen::VectorXd& v, HessianProjection curvature, Eigen::VectorXd& gradient,
                 std::vector<Eigen::Triplet<double>>& hessian) const override;
  double step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const override;
  double round_off() const override;

 private:
  Parts parts_;
};

// Null where there are none, a single one as it is.
std::shared_ptr<const VelocityPotential> sum_of(PotentialSum::Parts parts);

}  // namespace seiche
