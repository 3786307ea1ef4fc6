#pragma once
// Collision-free motion by conservative advancement (continuous collision detection).
#include "solid/contact/search.h"

namespace seiche::contact {

// Fraction (0 to 1) of the straight paths of its points that a pair can go while it keeps a share of its gap. No
// collision occurs up to there (conservative advancement along the current normal).
template <int Dim>
double pair_share(const typename ContactScene<Dim>::Data& scene, const Candidate& pair, const PairPoints<Dim>& from,
                  const PairPoints<Dim>& to, double reach);

template <int Dim>
struct Walk {
  double share = 0;  // of the motion to the target
  Placement<Dim> end;
  std::vector<Candidate> near;  // all pairs within reach at the end, and others
};

// Moves from a placement towards the target velocities, as far as the motion is certainly free of collisions.
template <int Dim>
Walk<Dim> walk(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval, const Placement<Dim>& from,
               const Velocities<Dim>& target, double reach);

}  // namespace seiche::contact
