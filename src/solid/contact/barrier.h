#pragma once
// The barrier energy of one pair with its derivatives.
#include "solid/contact/distance.h"

namespace seiche::contact {

struct Barrier {
  double value = 0, slope = 0, curvature = 0;  // J, N, N/m
};

// b(d) = -kappa (d - d^)^2 ln(d/d^) below the reach d^, 0 above (Li et al. 2020, of the distance itself).
Barrier barrier(double distance, double reach, double stiffness);

// The stiffness at which a pair at half the reach pushes with `force` (N/m).
double stiffness_for(double force, double reach);

template <int Dim>
struct PairEnergy {
  using Points = Eigen::Matrix<double, Dim, 4>;  // one column a point
  using Hessian = Eigen::Matrix<double, 4 * Dim, 4 * Dim>;
  double value = 0;
  double force = 0;  // N, along the normal
  Points gradient = Points::Zero();
  Hessian hessian = Hessian::Zero();  // may have negative eigenvalues
};

// Of the pair whose points are x. edges_at_rest: |u|^2 |v|^2 of two edges u, v at rest (m^4); 0 where both are rigid.
template <int Dim>
PairEnergy<Dim> pair_energy(PairKind kind, const PairPoints<Dim>& x, const Separation<Dim>& apart, double reach,
                            double stiffness, double edges_at_rest = 0);

// Its value alone.
template <int Dim>
double pair_value(PairKind kind, const PairPoints<Dim>& x, double distance, double reach, double stiffness,
                  double edges_at_rest = 0);

}  // namespace seiche::contact
