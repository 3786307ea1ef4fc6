#pragma once
// Primitive pairs with at least one deformable side: derivatives by the velocities that move their points.
#include "solid/contact/friction.h"
#include "solid/contact/search.h"

namespace seiche::contact {

// Velocity degrees of freedom of one pair: a twist for a rigid side, nodal velocities for a deformable one.
template <int Dim>
struct PairDofs {
  static constexpr int most = Dim == 2 ? 7 : 15;  // a point of a rigid body and an element
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, most, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;
  using Jacobian = Eigen::Matrix<double, 4 * Dim, Eigen::Dynamic, Eigen::ColMajor, 4 * Dim, most>;
  using SlipDerivative = Eigen::Matrix<double, Eigen::Dynamic, Dim - 1, Eigen::ColMajor, most, Dim - 1>;

  int count = 0;
  std::array<int, most> dof{};  // in the stacked velocities; -1: prescribed
  std::array<int, 2> begin{};   // first degree of freedom of each side
  Vector prescribed;            // velocities of prescribed sides, 0 elsewhere
  Vector lengths;               // 1 for velocities; the radius of the body for rotations
};

// second: a body, or -1 for a wall.
template <int Dim>
PairDofs<Dim> pair_dofs(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                        const Candidate& pair);

// Gradient and Hessian by velocities, from those by points after the interval. The change of the left Jacobian of SO(3)
// is neglected.
template <int Dim>
struct PairTerms {
  typename PairDofs<Dim>::Vector gradient;  // divided by H
  typename PairDofs<Dim>::Matrix hessian;   // divided by H^2
};
template <int Dim>
PairTerms<Dim> pair_terms(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                          const Placement<Dim>& at, const Candidate& pair, const PairDofs<Dim>& dofs,
                          const PairPoints<Dim>& x, const PairEnergy<Dim>& energy);

// Derivative of the slip components by the pair's velocities.
template <int Dim>
typename PairDofs<Dim>::SlipDerivative slip_derivative(const FrictionPoint<Dim>& f, const PairDofs<Dim>& dofs);

}  // namespace seiche::contact
