#pragma once
// Friction points from update to update of the normal forces.
#include "solid/contact/system.h"

namespace seiche::contact {

// Updates `points` to the present normal forces and contact points. Pairs that rubbed before keep the directions of
// their forces. Damped: bounds become the mean of those before, 0 for pairs that did not rub, and of the present ones.
template <int Dim>
void update_friction(const Scene<Dim>& scene, const Placement<Dim>& at, const std::vector<Candidate>& pairs,
                     const Weights& weights, bool damped, std::vector<FrictionPoint<Dim>>& points);

// Takes the directions of the forces along with Newton's step between the two velocities.
template <int Dim>
void turn_friction(const Velocities<Dim>& from, const Velocities<Dim>& to, double creep_speed,
                   std::vector<FrictionPoint<Dim>>& points);

}  // namespace seiche::contact
