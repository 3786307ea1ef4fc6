#pragma once
// Barrier and friction of all pairs as functions of the velocities.
#include "solid/contact/friction.h"
#include "solid/contact/search.h"
#include "solid/energy/curvature.h"

namespace seiche::contact {

struct Weights {
  double dt = 0, reach = 0, stiffness = 0, creep_speed = 0;
};

template <int Dim>
using Scene = typename ContactScene<Dim>::Data;

// C(v) = dt/H B(x(v)) + dt D(v) (J). K is its Hessian over the stacked velocities (but for what the change of J_l
// adds); drag is the product of the Hessian's mixed part with what the prescribed velocities still lack.
struct ContactTerms {
  double energy = 0, smallest_gap = 0;
  double tightest = 0;  // the smallest gap where each is measured in reaches of its pair, times the reach (m)
  int active = 0;
  Eigen::VectorXd gradient, drag;
  Eigen::SparseMatrix<double> K;
};

// Infinite if a pair touches.
template <int Dim>
double contact_energy(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                      const std::vector<Candidate>& pairs, const std::vector<FrictionPoint<Dim>>& friction,
                      const Weights& weights);

template <int Dim>
ContactTerms contact_terms(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                           const std::vector<Candidate>& pairs, const std::vector<FrictionPoint<Dim>>& friction,
                           const Weights& weights, Curvature curvature);

// The friction that the present normal forces and points of contact allow.
template <int Dim>
std::vector<FrictionPoint<Dim>> friction_points(const Scene<Dim>& scene, const Placement<Dim>& at,
                                                const std::vector<Candidate>& pairs, const Weights& weights);

// The impulses on all bodies about their centres in the present placement; in pairs equal and opposite.
template <int Dim>
std::vector<BodyImpulse> contact_impulses(const Scene<Dim>& scene, const Placement<Dim>& at,
                                          const std::vector<Candidate>& pairs,
                                          const std::vector<FrictionPoint<Dim>>& friction, const Weights& weights);

}  // namespace seiche::contact
