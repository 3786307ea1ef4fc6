#pragma once
// Keeps volumes above zero where a material's own energy would let them vanish: b(J) = (lambda + 2 mu) (J^/J - 1)^3
// below J^ = guarded_volume, nothing above; twice differentiable. Grows as J^-3, so that even a body thrown together
// far faster than its waves stops at a J that doubles resolve well.
#include <limits>

#include "solid/material/invariants.h"

namespace seiche::elastic {

inline constexpr double guarded_volume = 0.1;  // J^: below a tenth of its volume no material model means much

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
