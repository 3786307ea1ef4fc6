#pragma once
// Impacts as numbers of checkpoints.
#include <optional>
#include <vector>

#include "coupling/state/impact.h"

namespace seiche {

inline constexpr std::size_t numbers_of_impact = 10, numbers_of_impulse = 9;

// Numbers of each impact, the last of them the count of its impulses, then those of the impulses.
inline std::vector<double> pack_impacts(const Impacts& impacts) {
  std::vector<double> all;
  for (const Impact& i : impacts) {
    all.insert(all.end(), {double(i.first), double(i.second), double(i.stage), double(i.solves), i.approach, i.energy,
                           i.share, i.response, i.work, double(i.impulses.size())});
    for (const Impact::Impulse& one : i.impulses)
      for (const Vec3& v : {one.first_arm, one.second_arm, one.linear}) all.insert(all.end(), v.begin(), v.end());
  }
  return all;
}

// Empty where the numbers are not those of impacts between `solids` solids.
inline std::optional<Impacts> unpack_impacts(const std::vector<double>& all, std::size_t solids) {
  Impacts impacts;
  std::size_t n = 0;
  const auto is_solid = [&](double k) { return k >= 0 && k < double(solids); };
  while (n + numbers_of_impact <= all.size()) {
    const double* v = all.data() + n;
    n += numbers_of_impact;
    if (!is_solid(v[0]) || !(v[1] < 0 || is_solid(v[1])) || !(v[2] >= 0 && v[2] <= double(Impact::Stage::acted)))
      return {};
    impacts.push_back({int(v[0]), int(v[1]), Impact::Stage(int(v[2])), int(v[3]), v[4], v[5], v[6], v[7], v[8], {}});
    if (!(v[9] >= 0 && v[9] <= double((all.size() - n) / numbers_of_impulse))) return {};
    for (auto left = std::size_t(v[9]); left > 0; --left, n += numbers_of_impulse) {
      const double* x = all.data() + n;
      impacts.back().impulses.push_back({Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5]), Vec3(x[6], x[7], x[8])});
    }
  }
  return n == all.size() ? std::optional(std::move(impacts)) : std::nullopt;
}

}  // namespace seiche
