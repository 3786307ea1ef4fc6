#pragma once
// Energies of the velocities beside contact and the quadratic one of inertia: elastic bodies.
#include <vector>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include "solid/energy/curvature.h"

namespace seiche {

class VelocityPotential {
 public:
  virtual ~VelocityPotential();
  // J; infinite where it is not defined (inverted elements).
  virtual double energy(const Eigen::VectorXd& v) const = 0;
  // Adds the gradient (N s, of the size of v) at v.
  virtual void add_gradient(const Eigen::VectorXd& v, Eigen::VectorXd& gradient) const = 0;
  // Adds the gradient and the entries of the Hessian (kg).
  virtual void add_terms(const Eigen::VectorXd& v, Curvature curvature, Eigen::VectorXd& gradient,
                         std::vector<Eigen::Triplet<double>>& hessian) const = 0;
  // The largest share of the step dv, at most 1, without inversion.
  virtual double step_bound(const Eigen::VectorXd& v, const Eigen::VectorXd& dv) const = 0;
  // What round-off may add to energy() (J): differences below say nothing.
  virtual double round_off() const { return 0; }
};

}  // namespace seiche
