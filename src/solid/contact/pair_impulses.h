#pragma once
// Normal impulses of single pairs, for restitution.
#include "solid/contact/system.h"

namespace seiche::contact {

// Impulses of bodies that do not deform, one for each pair of primitives within reach.
template <int Dim>
std::vector<PairImpulse> pair_impulses(const Scene<Dim>& scene, const Placement<Dim>& at,
                                       const std::vector<Candidate>& pairs, const Weights& weights);

}  // namespace seiche::contact
