#pragma once
// Pairs of solids that [[contact]] names.
#include <optional>

#include "coupling/geometry/seams.h"
#include "solid/contact/contact.h"

namespace seiche {

struct Scene;
struct ContactSpec;

// Pairs that do not touch: `jointed` ones, and those that the scene lets pass through each other. Ascending.
SharedPairs pairs_apart(const Scene& scene, SharedPairs jointed);

// Coefficients of pairs that have one of their own, friction or restitution. The last entry that fits a pair counts.
PairCoefficients pair_coefficients(const Scene& scene, std::optional<double> ContactSpec::*member);

}  // namespace seiche
