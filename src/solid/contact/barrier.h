#pragma once
// The barrier energy of one pair with its derivatives.
#include "solid/contact/distance.h"

namespace seiche::contact {

struct Barrier {
  double value = 0, slope = 0, curvature = 0;  // J, N, N/m
};

// Barrier b(d) = -kappa (d - d^)^2 ln(d/d^) below d^ = reach, 0 above. Follows Li et al. 2020, as a function of the
// distance itself.
Barrier barrier(double distance, double reach, double stiffness);

// Stiffness kappa (N/m) at which a pair at half the reach repels with `force` (N).
double stiffness_for(double force, double reach);

template <int Dim>
struct PairEnergy {
  using Points = Eigen::Matrix<double, Dim, 4>;  // one column a point
  using Hessian = Eigen::Matrix<double, 4 * Dim, 4 * Dim>;
  double value = 0;
  double force = 0;  // normal force, N
  Points gradient = Points::Zero();
  Hessian hessian = Hessian::Zero();  // may have negative eigenvalues
};

// Energy of one pair with points x. edges_at_rest: |u|^2 |v|^2 of two edges u, v at rest (m^4), or 0 if both are rigid.
template <int Dim>
PairEnergy<Dim> pair_energy(PairKind kind, const PairPoints<Dim>& x, const Separation<Dim>& apart, double reach,
                            double stiffness, double edges_at_rest = 0);

// The value only.
template <int Dim>
double pair_value(PairKind kind, const PairPoints<Dim>& x, double distance, double reach, double stiffness,
                  double edges_at_rest = 0);

}  // namespace seiche::contact
