#pragma once
// Smoothed Coulomb friction. Normal forces, contact points and tangents are lagged: fixed while velocities are solved
// for.
#include "solid/contact/barrier.h"
#include "solid/contact/search.h"

namespace seiche::contact {

// psi(y): |y| for y above eps, smooth below (Li et al. 2020): psi' = f(y) = 2 y/eps - (y/eps)^2.
struct SlipLaw {
  double value = 0, over_speed = 0, curvature = 0;  // psi (m/s), psi'/y and psi'' (s/m)

  // d/dy of eta = y/psi', 0 to 1.
  double slowness_change(double y) const {
    return y > 0 ? (over_speed - curvature) / (over_speed * over_speed * y) : 0;
  }
};
SlipLaw slip_law(double speed, double creep_speed);

// One pressed pair. Two rigid bodies both act at the middle of the gap. A rigid and a deformable body act at the
// latter's nearest point, so that friction has no moment. Two deformable bodies each act at their own nearest point.
template <int Dim>
struct FrictionPoint {
  int first, second;  // bodies; -1 for a wall
  double bound;       // mu times the normal force, N
  Vec<Dim> arm_first, arm_second;
  Eigen::Matrix<double, Dim, Dim - 1> tangent;
  bool first_deforms = false, second_deforms = false;
  Candidate pair = {};
  std::array<double, 4> weight = {};  // of the nearest point by the pair's points, as in Separation
  // Dual variable w: the friction force over its bound, at most 1 long. At the minimum w = psi' u/|u|.
  Eigen::Matrix<double, Dim - 1, 1> direction = Eigen::Matrix<double, Dim - 1, 1>::Zero();

  bool deforms() const { return first_deforms || second_deforms; }
};

// Orthonormal tangent directions to a unit normal.
template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> tangents(const Vec<Dim>& normal);

// Combined friction coefficient. Both set: geometric mean; one set: that one; none: 0.
double pair_friction(const std::optional<double>& a, const std::optional<double>& b);

// Slip u = T'(v_a + omega_a x r_a - v_b - omega_b x r_b) (m/s). A deformable body contributes the velocity of its
// nearest point, sum w_i v_i.
template <int Dim>
Eigen::Matrix<double, Dim - 1, 1> slip(const FrictionPoint<Dim>& at, const Velocities<Dim>& velocities);

// Friction power bound * psi(|u|), with its gradient by the slip u and the positive semi-definite Hessian of the
// primal-dual method (Chan, Golub, Mulet 1999), eta = |u|/psi', t = u/|u|:
//   bound/eta (1 - eta'/2 (w t' + t w')),   the exact one if w = u/eta.
// With the exact one Newton's method takes a point that sticks from side to side of its kink by tiny steps.
template <int Dim>
struct SlipEnergy {
  double value = 0;  // W
  Eigen::Matrix<double, Dim - 1, 1> gradient;
  Eigen::Matrix<double, Dim - 1, Dim - 1> hessian;
};
template <int Dim>
SlipEnergy<Dim> slip_energy(const FrictionPoint<Dim>& at, const Eigen::Matrix<double, Dim - 1, 1>& u,
                            double creep_speed);

// The direction w after Newton's step from slip u to u + du: eta w = u, linearised at (u, w), cut to length 1.
template <int Dim>
Eigen::Matrix<double, Dim - 1, 1> next_direction(const FrictionPoint<Dim>& at,
                                                 const Eigen::Matrix<double, Dim - 1, 1>& u,
                                                 const Eigen::Matrix<double, Dim - 1, 1>& du, double creep_speed);

}  // namespace seiche::contact
