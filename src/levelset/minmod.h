#pragma once
// The limiter of slopes and second differences.
#include <cmath>

namespace seiche {

// The one of smaller magnitude if both have the same sign, else 0.
inline double minmod(double a, double b) {
  return a * b <= 0 ? 0 : (std::abs(a) < std::abs(b) ? a : b);
}

}  // namespace seiche
