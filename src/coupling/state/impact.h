#pragma once
// Pairs of rigid solids that meet fast enough to rebound (solids/rebound.h).
#include <vector>

#include "base/vec.h"

namespace seiche {

struct Impact {
  // Impulse of contact at a place, given by its arms from the centres of mass (m). The solids move along with them.
  struct Impulse {
    Vec3 first_arm, second_arm, linear;  // N s on the first solid, the opposite on the second
  };
  enum class Stage : char {
    meeting,  // contact brings them to rest against each other
    due,      // the rebound, or a correction of it, acts in the coming solve
    acted     // it was part of the last solve
  };
  int first = 0, second = 0;  // solids; second below 0: a side of the domain, as in PairImpulse
  Stage stage = Stage::meeting;
  int solves = 0;  // since they met; once due: corrections so far
  // Speed of approach before this and all neighbouring impacts, with what forces add on the way that is left, m/s. Once
  // due: that after the rebound, below 0.
  double approach = 0;
  double energy = 0;  // that contact has taken from them; once due: that the rebound may give back, J (2D: J/m)
  // Once due: the rebound over the impulses of contact, and the change of speed by it times its impulse, if there were
  // no liquid (J).
  double share = 0, response = 0;
  double work = 0;                // of the rebound that has acted, J (2D: J/m)
  std::vector<Impulse> impulses;  // of contact since they met
};

using Impacts = std::vector<Impact>;

}  // namespace seiche
