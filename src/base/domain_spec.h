#pragma once
// The table [domain] of a scene. Plain data in SI units.
#include <optional>

#include "base/formula.h"
#include "base/motion_spec.h"
#include "base/side_type.h"
#include "base/vec.h"

namespace seiche {

// Waves that enter through a side and leave through it.
struct SideWavesSpec : WavesSpec {
  bool absorbs = true;          // waves that come to the side
  std::optional<double> level;  // coordinate of the surface at rest, m; unset: depth above the bottom of the domain
  std::optional<Vec3> towards;  // direction of the waves; unset: across the side, inward
};

struct SideSpec {
  SideType type = SideType::free_slip;
  VectorFormula velocity{"0", "0", "0"};  // inflow, moving_wall
  Formula pressure = "0";                 // outflow, Pa
  SideWavesSpec waves{};                  // waves
};

struct DomainSpec {
  Vec3 lower{0, 0, 0}, upper{1, 1, 1};
  double cell_size = 0;
  std::array<int, 3> cells{1, 1, 1};             // 1 along z in 2D
  std::array<std::array<SideSpec, 2>, 3> sides;  // [axis][0 = lower, 1 = upper]
};

}  // namespace seiche
