#pragma once
// Friction points from update to update of the normal forces.
#include "solid/contact/system.h"

namespace seiche::contact {

// Updates `points` to the present normal forces and contact points. Pairs that rubbed before keep the directions of
// their forces. `taken` < 1: bounds become taken times the present ones plus 1 - taken times those before, 0 for pairs
// that did not rub; the others keep the points where their forces act.
template <int Dim>
void update_friction(const Scene<Dim>& scene, const Placement<Dim>& at, const std::vector<Candidate>& pairs,
                     const Weights& weights, double taken, std::vector<FrictionPoint<Dim>>& points);

// Takes the directions of the forces along with Newton's step between the two velocities.
template <int Dim>
void turn_friction(const Velocities<Dim>& from, const Velocities<Dim>& to, double creep_speed,
                   std::vector<FrictionPoint<Dim>>& points);

}  // namespace seiche::contact
