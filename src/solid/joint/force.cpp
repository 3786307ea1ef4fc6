#include "solid/joint/force.h"

#include <algorithm>
#include <cmath>

namespace seiche {

double CappedForce::impulse(double r) const {
  return std::clamp(-slope * (r - rest), -most, most);
}

double CappedForce::energy(double r) const {
  const double off = std::abs(r - rest);
  return slope * off <= most ? 0.5 * slope * off * off : most * (off - 0.5 * most / slope);
}

double CappedForce::curvature(double r) const {
  return slope * std::abs(r - rest) <= most ? slope : 0;
}

}  // namespace seiche
