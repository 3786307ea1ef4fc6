#pragma once
// Pairs of rigid solids that meet fast enough to rebound (solids/rebound.h).
#include <vector>

#include "base/vec.h"

namespace seiche {

struct Impact {
  struct Impulse {
    Vec3 point, linear;  // m; N s on the first solid, the opposite on the second
  };
  int first = 0, second = 0;  // solids; second below 0: a side of the domain, as in PairImpulse
  // Normal speed of approach where they touch, m/s: at first as they meet, then with what gravity adds on the way that
  // is left. 0 once the rebound has acted in a solve.
  double approach = 0;
  double driven = 0;              // speed beside it that contact takes from them, from forces meanwhile, m/s
  bool is_due = false;            // they have stopped approaching: the rebound acts in the coming solve
  std::vector<Impulse> impulses;  // of contact since they met
};

using Impacts = std::vector<Impact>;

}  // namespace seiche
