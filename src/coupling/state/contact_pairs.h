#pragma once
// Pairs of solids that [[contact]] names.
#include "coupling/geometry/seams.h"
#include "solid/contact/contact.h"

namespace seiche {

struct Scene;

// Pairs that do not touch: `jointed` ones, and those that the scene lets pass through each other. Ascending.
SharedPairs pairs_apart(const Scene& scene, SharedPairs jointed);

// Friction of pairs that has a coefficient of its own. The last entry that fits a pair counts.
PairFrictions pair_frictions(const Scene& scene);

// Restitution of pairs that have a coefficient, likewise.
PairFrictions pair_restitutions(const Scene& scene);

}  // namespace seiche
