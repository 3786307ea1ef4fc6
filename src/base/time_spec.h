#pragma once
// The table [time] of a scene. Plain data in SI units.
#include <optional>

namespace seiche {

enum class TimeScheme { first_order, second_order };

struct TimeSpec {
  double end = 1;
  double frame_rate = 24;
  double cfl = 1;
  std::optional<double> max_step, fixed_step;
  TimeScheme scheme = TimeScheme::second_order;
};

}  // namespace seiche
