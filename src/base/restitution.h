#pragma once
// Solids that may rebound from each other by a coefficient of restitution.
#include "base/solid_kind.h"

namespace seiche {

// False for solids that give back energy by their own motion, or whose points all move as prescribed.
constexpr bool may_rebound(const SolidKind& kind) {
  return !kind.deforms() && (!kind.is_free() || kind.may_turn);
}

}  // namespace seiche
