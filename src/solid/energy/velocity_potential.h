#pragma once
// Energies of the velocities besides contact and inertia: elastic bodies. Processes may share the work (WorkShare), so
// all of them call energies, gradients, Hessians and bounds together.
#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "base/index_range.h"
#include "solid/energy/hessian_projection.h"

namespace seiche {

class VelocityPotential {
 public:
  virtual ~VelocityPotential();
  // Energy, J; infinite where undefined (inverted elements).
  virtual double energy(const Eigen::VectorXd& v) const = 0;
  // Adds the gradient (N s, of the size of v) at v.
  virtual void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const = 0;
  // Hessian (kg) at v, a square matrix of the size of v with the given columns; the others are empty. All processes ask
  // for all columns, or each for its part.
  virtual Eigen::SparseMatrix<double> hessian(const Eigen::VectorXd& v, HessianProjection curvature,
                                              IndexRange columns) const = 0;
  // Largest share of the step dv, at most 1, without inversion.
  virtual double step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const = 0;
  // Largest angle, rad, by which the step dv turns a body that is free to turn. Its line stretches the body by the
  // square.
  virtual double angle(const Eigen::VectorXd& /*v*/, const Eigen::VectorXd& /*dv*/) const { return 0; }
  // Replaces the step dv by the arc of its rotations: displacements t + (R - 1) r + R q in place of t + a x r + q,
  // where a is the mean rotation, R = exp(a), r the place from the mean, q the remainder.
  virtual void turn(const Eigen::VectorXd& /*v*/, Eigen::VectorXd& /*dv*/) const {}
  // Round-off error of energy() (J): smaller differences are noise.
  virtual double round_off() const { return 0; }
};

}  // namespace seiche
