#pragma once
// The table [domain] of a scene. Plain data in SI units.
#include "base/formula.h"
#include "base/side_type.h"
#include "base/vec.h"

namespace seiche {

struct SideSpec {
  SideType type = SideType::free_slip;
  VectorFormula velocity{"0", "0", "0"};  // inflow, moving_wall
  Formula pressure = "0";                 // outflow, Pa
};

struct DomainSpec {
  Vec3 lower{0, 0, 0}, upper{1, 1, 1};
  double cell_size = 0;
  std::array<int, 3> cells{1, 1, 1};             // 1 along z in 2D
  std::array<std::array<SideSpec, 2>, 3> sides;  // [axis][0 = lower, 1 = upper]
};

}  // namespace seiche
