#pragma once
// Motion that surely is free of collisions.
#include "solid/contact/search.h"

namespace seiche::contact {

// How far (0 to 1) a pair can go along the straight paths of its points so that it keeps a share of its gap. Surely no
// collision up to there (conservative advancement along the current normal).
template <int Dim>
double pair_share(const typename ContactScene<Dim>::Data& scene, const Candidate& pair, const PairPoints<Dim>& from,
                  const PairPoints<Dim>& to, double reach);

template <int Dim>
struct Walk {
  double share = 0;  // of the way to the target
  Placement<Dim> end;
  std::vector<Candidate> near;  // all pairs within reach at the end, and others
};

// Goes from a placement towards the target velocities, as far as that surely is free of collisions.
template <int Dim>
Walk<Dim> walk(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval, const Placement<Dim>& from,
               const Velocities<Dim>& target, double reach);

}  // namespace seiche::contact
