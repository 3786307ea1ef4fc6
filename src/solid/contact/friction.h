#pragma once
// Smoothed Coulomb friction whose normal forces, points and tangents are held while velocities are sought.
#include "solid/contact/barrier.h"
#include "solid/contact/search.h"

namespace seiche::contact {

// psi(y): |y| for y above eps, smooth below (Li et al. 2020): psi' = f(y) = 2 y/eps - (y/eps)^2.
struct SlipLaw {
  double value = 0, over_speed = 0, curvature = 0;  // psi (m/s), psi'/y and psi'' (s/m)
};
SlipLaw slip_law(double speed, double creep_speed);

// One pair that is pressed together. Two rigid bodies are both taken at the middle of the gap, a rigid and a deformable
// one at the latter's nearest point, so that friction has no moment; two deformable ones at the nearest point of each.
template <int Dim>
struct FrictionPoint {
  int first, second;  // bodies; -1 for a wall
  double bound;       // N: mu times the normal force
  Vec<Dim> arm_first, arm_second;
  Eigen::Matrix<double, Dim, Dim - 1> tangent;
  bool first_deforms = false, second_deforms = false;
  Candidate pair = {};
  std::array<double, 4> weight = {};  // of the pair's points: the nearest point's, as in Separation

  bool deforms() const { return first_deforms || second_deforms; }
};

// Orthonormal directions across a unit normal.
template <int Dim>
Eigen::Matrix<double, Dim, Dim - 1> tangents(const Vec<Dim>& normal);

// Both set: the geometric mean; one set: that; none: 0.
double pair_friction(const std::optional<double>& a, const std::optional<double>& b);

// The slip u = T'(v_a + omega_a x r_a - v_b - omega_b x r_b) (m/s); a deformable body has the velocity of its nearest
// point, sum w_i v_i.
template <int Dim>
Eigen::Matrix<double, Dim - 1, 1> slip(const FrictionPoint<Dim>& at, const Velocities<Dim>& velocities);

// bound * psi(|u|) with its gradient and positive semi-definite Hessian, by the slip.
template <int Dim>
struct SlipEnergy {
  double value = 0;  // W
  Eigen::Matrix<double, Dim - 1, 1> gradient;
  Eigen::Matrix<double, Dim - 1, Dim - 1> hessian;
};
template <int Dim>
SlipEnergy<Dim> slip_energy(const FrictionPoint<Dim>& at, const Eigen::Matrix<double, Dim - 1, 1>& u,
                            double creep_speed);

}  // namespace seiche::contact
