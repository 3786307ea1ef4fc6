#pragma once
// Volume barrier for strong compression: b(J) = (lambda + 2 mu) (J^/J - 1)^3 below J^ = guarded_volume, 0 above. It is
// twice differentiable and grows as J^-3. Hence even a body that is hit far faster than its wave speed stops at a J
// that doubles resolve well, also if the material's own energy lets volumes vanish.
#include <limits>

#include "solid/material/invariants.h"

namespace seiche::elastic {

inline constexpr double guarded_volume = 0.1;  // J^: below it no material model is realistic

struct Guard {
  double value = 0, slope = 0, curvature = 0;  // b, b', b'', Pa
};

inline Guard volume_guard(const Lame& m, double J) {
  if (J >= guarded_volume) return {};
  if (!(J > 0)) return {std::numeric_limits<double>::infinity(), 0, 0};
  const double kappa = m.lambda + 2 * m.mu, y = guarded_volume / J - 1, slope = -guarded_volume / (J * J);
  return {kappa * y * y * y, 3 * kappa * y * y * slope,
          kappa * (6 * y * slope * slope + 6 * y * y * guarded_volume / (J * J * J))};
}

}  // namespace seiche::elastic
