#pragma once
// Pairs of rigid solids that meet fast enough to rebound (solids/rebound.h).
#include <vector>

#include "base/vec.h"

namespace seiche {

struct Impact {
  struct Impulse {
    Vec3 point, linear;  // m; N s on the first solid, the opposite on the second
  };
  int first = 0, second = 0;      // solids; second below 0: a side of the domain, as in PairImpulse
  double approach = 0;            // normal speed at which they met, m/s
  double driven = 0;              // speed that forces other than contact have added to it since, m/s
  bool is_due = false;            // they have stopped approaching: the rebound acts in the coming solve
  std::vector<Impulse> impulses;  // of contact since they met
};

using Impacts = std::vector<Impact>;

}  // namespace seiche
