#pragma once
// Impulses of pairs of rigid bodies that meet at once. Impulses l >= 0 change the speeds at which the pairs part from w
// to w + A l, with A = W'M^-1 W, symmetric and semi-definite.
#include <Eigen/Core>

namespace seiche {

// Impulses after which no pair approaches, and those that push are at rest: l >= 0, w + A l >= 0, l'(w + A l) = 0.
Eigen::VectorXd stopping_impulses(const Eigen::MatrixXd& A, const Eigen::VectorXd& w);

// Impulses with which pairs of these coefficients of restitution rebound, one after the other where an impact passes
// from pair to pair: generalised reflections (Smith, Kaufman, Vouga, Tamstorf, Grinspun, Reflections on simultaneous
// impact, 2012). No energy is gained, and no pair approaches in the end.
Eigen::VectorXd rebound_impulses(const Eigen::MatrixXd& A, const Eigen::VectorXd& w, const Eigen::VectorXd& e);

// Largest share s >= 0 with slope s + curvature s^2/2 <= energy (J); where there is none, that of least energy.
double share_within(double slope, double curvature, double energy);

}  // namespace seiche
