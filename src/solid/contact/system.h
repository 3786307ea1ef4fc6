#pragma once
// Barrier and friction of all pairs as functions of the velocities.
#include "base/index_range.h"
#include "solid/contact/friction.h"
#include "solid/contact/search.h"
#include "solid/energy/hessian_projection.h"

namespace seiche::contact {

struct Weights {
  double dt = 0, reach = 0, stiffness = 0, creep_speed = 0;
};

template <int Dim>
using Scene = typename ContactScene<Dim>::Data;

// C(v) = dt/H B(x(v)) + dt D(v) (J). K: its Hessian by the stacked velocities, without the change of J_l. drag: the
// mixed part of the Hessian times the missing part of the prescribed velocities.
struct ContactTerms {
  double energy = 0, smallest_gap = 0;
  double tightest = 0;  // smallest gap (m) when each gap is scaled to the common reach
  int active = 0;
  Eigen::VectorXd gradient, drag;
  Eigen::SparseMatrix<double> K;
};

// Energy C (J); infinite if a pair touches.
template <int Dim>
double contact_energy(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                      const std::vector<Candidate>& pairs, const std::vector<FrictionPoint<Dim>>& friction,
                      const Weights& weights);

// Fills the `columns` of K alone.
template <int Dim>
ContactTerms contact_terms(const Scene<Dim>& scene, const Interval<Dim>& interval, const Placement<Dim>& at,
                           const std::vector<Candidate>& pairs, const std::vector<FrictionPoint<Dim>>& friction,
                           const Weights& weights, HessianProjection curvature, IndexRange columns);

// Friction points with their bounds for the present normal forces and contact points.
template <int Dim>
std::vector<FrictionPoint<Dim>> friction_points(const Scene<Dim>& scene, const Placement<Dim>& at,
                                                const std::vector<Candidate>& pairs, const Weights& weights);

// Impulses on all bodies about their centres in the present placement; equal and opposite within a pair.
template <int Dim>
std::vector<BodyImpulse> contact_impulses(const Scene<Dim>& scene, const Placement<Dim>& at,
                                          const std::vector<Candidate>& pairs,
                                          const std::vector<FrictionPoint<Dim>>& friction, const Weights& weights);

}  // namespace seiche::contact
