// Measures of solids.
#include <algorithm>

#include "files/checked_file.h"
#include "validate/measure/kinds.h"

namespace seiche {
namespace {

Points solid_series(const MeasureSpec& spec, const RunPaths& run) {
  return solid_points(read_whole_file(run.solids()), spec.solid, spec.column);
}

// Mean over from <= t <= to, with a window that suppresses oscillations.
Measurement solid_mean(const MeasureSpec& spec, const RunPaths& run) {
  const double mean = settled_mean(solid_series(spec, run), spec.from, spec.to);
  const double reference = constant(spec.reference);
  return {mean, reference, std::abs(mean - reference) / constant(spec.length_unit)};
}

// Least-squares slope over from <= t <= to.
Measurement solid_slope(const MeasureSpec& spec, const RunPaths& run) {
  return against(slope_during(solid_series(spec, run), spec.from, spec.to), constant(spec.reference));
}

Points solid_during(const MeasureSpec& spec, const RunPaths& run) {
  return points_during(solid_series(spec, run), spec.from, spec.to);
}

Measurement solid_peak(const MeasureSpec& spec, const RunPaths& run) {
  return against(peak_during(solid_series(spec, run), spec.from, spec.to).second, constant(spec.reference));
}

Measurement solid_period(const MeasureSpec& spec, const RunPaths& run) {
  return against(mean_period(solid_during(spec, run), constant(spec.level)), constant(spec.reference));
}

std::pair<double, double> solid_extremes(const MeasureSpec& spec, const RunPaths& run) {
  return extremes_during(solid_series(spec, run), spec.from, spec.to);
}

// Half the difference of the extremes.
Measurement solid_amplitude(const MeasureSpec& spec, const RunPaths& run) {
  const auto [low, high] = solid_extremes(spec, run);
  return against(0.5 * (high - low), constant(spec.reference));
}

// Mean of the extremes.
Measurement solid_middle(const MeasureSpec& spec, const RunPaths& run) {
  const auto [low, high] = solid_extremes(spec, run);
  return against(0.5 * (high + low), constant(spec.reference));
}

// (value - level)/length_unit over time/time_unit, compared with the data.
Measurement solid_rms(const MeasureSpec& spec, const RunPaths& run) {
  Points points = solid_series(spec, run);
  const double time_unit = constant(spec.time_unit), unit = constant(spec.length_unit), level = constant(spec.level);
  for (auto& [time, value] : points) time /= time_unit, value = (value - level) / unit;
  return itself(rms_difference(points, csv_points(read_whole_file(spec.data))));
}

Measurement solid_root_mean_square(const MeasureSpec& spec, const RunPaths& run) {
  return against(root_mean_square(solid_series(spec, run), spec.from, spec.to), constant(spec.reference));
}

Measurement solids_stray(const MeasureSpec& spec, const RunPaths& run) {
  const double way = farthest_stray(read_whole_file(run.solids()), spec.from) / constant(spec.length_unit);
  return {way, {}, way};
}

}  // namespace

std::vector<MeasureKind> measures_of_solids() {
  return {
      {"solid_mean", {"solid", "column", "from", "to", "reference", "length_unit"}, solid_mean, solid_series},
      {"solid_slope", {"solid", "column", "from", "to", "reference"}, solid_slope, solid_series},
      {"solid_peak", {"solid", "column", "from", "to", "reference"}, solid_peak, solid_series},
      {"solid_period", {"solid", "column", "level", "from", "to", "reference"}, solid_period, solid_series},
      {"solid_amplitude", {"solid", "column", "from", "to", "reference"}, solid_amplitude, solid_series},
      {"solid_middle", {"solid", "column", "from", "to", "reference"}, solid_middle, solid_series},
      {"solid_rms", {"solid", "column", "level", "time_unit", "length_unit", "data"}, solid_rms, solid_series},
      {"solid_root_mean_square", {"solid", "column", "from", "to", "reference"}, solid_root_mean_square, solid_series},
      {"solids_stray", {"from", "length_unit"}, solids_stray},
  };
}

}  // namespace seiche
