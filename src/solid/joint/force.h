#pragma once
// Forces of joints along their coordinates, as convex functions of the coordinate's rate.
#include <limits>

namespace seiche {

// Impulse -slope (r - rest), at most `most` in magnitude, along a coordinate whose rate is r.
struct CappedForce {
  double slope = 0;                                       // N s^2/m, or N m s^2
  double rest = 0;                                        // m/s, rad/s
  double most = std::numeric_limits<double>::infinity();  // N s, N m s

  bool is_linear() const { return most == std::numeric_limits<double>::infinity(); }
  double impulse(double r) const;
  double energy(double r) const;     // J s; its derivative is -impulse
  double curvature(double r) const;  // at the cap: 0
};

}  // namespace seiche
