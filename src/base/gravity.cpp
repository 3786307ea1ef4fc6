#include "base/gravity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace seiche {

// The shortest texts that read back to the same numbers.
GravitySpec::GravitySpec(double x, double y, double z)
    : formula{fmt::format("{}", x), fmt::format("{}", y), fmt::format("{}", z)} {}

Vec3 Gravity::of_step(double end, double dt) const {
  return at(end - 0.5 * dt);
}

double Gravity::largest(double from, double to) const {
  constexpr int looks = 1000;
  if (value_.is_constant()) return at(from).norm();
  double most = 0;
  for (int n = 0; n <= looks; ++n) {
    const double g = at(from + (to - from) * n / looks).norm();
    if (std::isfinite(g)) most = std::max(most, g);
  }
  return most;
}

std::string Gravity::fault(double t) const {
  const Vec3 g = at(t);
  for (int a = 0; a < 3; ++a)
    if (!std::isfinite(g[a]))
      return fmt::format("gravity[{}] = \"{}\" is {} at t = {:g} s; it must be a finite number there", a,
                         spec_.formula[a], std::isnan(g[a]) ? "nan" : "infinite", t);
  return {};
}

}  // namespace seiche
