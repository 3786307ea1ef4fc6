// Measures of probes.
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "files/checked_file.h"
#include "validate/measure/kinds.h"

namespace seiche {
namespace {

Measurement period_of_probe(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = probe_points(read_whole_file(run.probes()), spec.probe);
  return against(mean_period(points, constant(spec.level)), constant(spec.reference));
}

Points component_of_probe(const MeasureSpec& spec, const RunPaths& run) {
  return probe_points(read_whole_file(run.probes()), spec.probe, spec.column);
}

Measurement probe_period(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = points_during(component_of_probe(spec, run), spec.from, spec.to);
  return against(mean_period(points, constant(spec.level)), constant(spec.reference));
}

Measurement probe_period_scatter(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = points_during(component_of_probe(spec, run), spec.from, spec.to);
  return itself(period_scatter(points, constant(spec.level)));
}

Measurement probe_mean(const MeasureSpec& spec, const RunPaths& run) {
  return against(settled_mean(component_of_probe(spec, run), spec.from, spec.to), constant(spec.reference));
}

std::pair<double, double> probe_extremes(const MeasureSpec& spec, const RunPaths& run) {
  return extremes_during(component_of_probe(spec, run), spec.from, spec.to);
}

Measurement probe_peak(const MeasureSpec& spec, const RunPaths& run) {
  return against(peak_during(component_of_probe(spec, run), spec.from, spec.to).second, constant(spec.reference));
}

// Time of the peak, s.
Measurement probe_peak_time(const MeasureSpec& spec, const RunPaths& run) {
  return against(peak_during(component_of_probe(spec, run), spec.from, spec.to).first, constant(spec.reference));
}

Points impact_series(const MeasureSpec& spec, const RunPaths& run) {
  return impact_points(read_whole_file(run.probes()), spec.probe);
}

Points::value_type impact(const MeasureSpec& spec, const RunPaths& run) {
  return highest_during(impact_series(spec, run), spec.from, spec.to);
}

Measurement impact_peak(const MeasureSpec& spec, const RunPaths& run) {
  return against(impact(spec, run).second, constant(spec.reference));
}

Measurement impact_peak_time(const MeasureSpec& spec, const RunPaths& run) {
  return against(impact(spec, run).first, constant(spec.reference));
}

Points scalar_series(const MeasureSpec& spec, const RunPaths& run) {
  return probe_points(read_whole_file(run.probes()), spec.probe);
}

// Time of the probe's first value, s.
Measurement probe_arrival(const MeasureSpec& spec, const RunPaths& run) {
  return against(scalar_series(spec, run).front().first, constant(spec.reference));
}

// Half the difference of the extremes.
Measurement probe_amplitude(const MeasureSpec& spec, const RunPaths& run) {
  const auto [low, high] = probe_extremes(spec, run);
  return against(0.5 * (high - low), constant(spec.reference));
}

// Mean of the extremes.
Measurement probe_middle(const MeasureSpec& spec, const RunPaths& run) {
  const auto [low, high] = probe_extremes(spec, run);
  return against(0.5 * (high + low), constant(spec.reference));
}

Points front_series(const MeasureSpec& spec, const RunPaths& run) {
  Points points = probe_points(read_whole_file(run.probes()), spec.probe);
  const double time_unit = constant(spec.time_unit), length_unit = constant(spec.length_unit);
  for (auto& [time, length] : points) time /= time_unit, length /= length_unit;
  return points;
}

// Slope of the part between `from` and `to`, all of which must exist.
double front_speed(const Points& front, double from, double to) {
  const auto below = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto [least, most] = std::minmax_element(front.begin(), front.end(), below);
  if (front.empty() || least->second > from || most->second < to)
    throw Error(ExitCode::cannot_continue, fmt::format("the front does not go from {:g} to {:g}", from, to));
  return slope_between(front, from, to);
}

Measurement front_slope(const MeasureSpec& spec, const RunPaths& run) {
  return against(front_speed(front_series(spec, run), spec.from, spec.to),
                 front_speed(csv_points(read_whole_file(spec.data)), spec.from, spec.to));
}

// (value - level)/length_unit over time/time_unit.
Points scaled_probe(const MeasureSpec& spec, const RunPaths& run) {
  Points points = probe_points(read_whole_file(run.probes()), spec.probe);
  const double time_unit = constant(spec.time_unit), unit = constant(spec.length_unit), level = constant(spec.level);
  for (auto& [time, value] : points) time /= time_unit, value = (value - level) / unit;
  return points;
}

Measurement probe_rms(const MeasureSpec& spec, const RunPaths& run) {
  return itself(rms_difference(scaled_probe(spec, run), csv_points(read_whole_file(spec.data))));
}

Measurement probe_deviation(const MeasureSpec& spec, const RunPaths& run) {
  return itself(largest_difference(scaled_probe(spec, run), csv_points(read_whole_file(spec.data))));
}

Measurement probe_growth(const MeasureSpec& spec, const RunPaths& run) {
  return against(growth_rate(scalar_series(spec, run), constant(spec.level), spec.from, spec.to),
                 constant(spec.reference));
}

// Difference of two probes' windowed means.
Measurement probe_difference(const MeasureSpec& spec, const RunPaths& run) {
  const std::string text = read_whole_file(run.probes());
  const auto mean = [&](const std::string& probe) {
    return settled_mean(probe_points(text, probe, spec.column), spec.from, spec.to);
  };
  return against(mean(spec.probe) - mean(spec.minus), constant(spec.reference));
}

double decay_of_probe(const MeasureSpec& spec, const RunPaths& run) {
  return energy_decay(scalar_series(spec, run), constant(spec.level));
}

Measurement probe_decay(const MeasureSpec& spec, const RunPaths& run) {
  return itself(std::abs(decay_of_probe(spec, run)));
}

Measurement probe_decay_rate(const MeasureSpec& spec, const RunPaths& run) {
  return against(decay_of_probe(spec, run), constant(spec.reference));
}

}  // namespace

std::vector<MeasureKind> measures_of_probes() {
  return {
      {"period_of_probe", {"probe", "level", "reference"}, period_of_probe, scalar_series},
      {"probe_period", {"probe", "column", "level", "from", "to", "reference"}, probe_period, component_of_probe},
      {"probe_period_scatter", {"probe", "column", "level", "from", "to"}, probe_period_scatter, component_of_probe},
      {"probe_mean", {"probe", "column", "from", "to", "reference"}, probe_mean, component_of_probe},
      {"probe_peak", {"probe", "column", "from", "to", "reference"}, probe_peak, component_of_probe},
      {"probe_peak_time", {"probe", "column", "from", "to", "reference"}, probe_peak_time, component_of_probe},
      {"impact_peak", {"probe", "from", "to", "reference"}, impact_peak, impact_series},
      {"impact_peak_time", {"probe", "from", "to", "reference"}, impact_peak_time, impact_series},
      {"probe_arrival", {"probe", "reference"}, probe_arrival, scalar_series},
      {"probe_amplitude", {"probe", "column", "from", "to", "reference"}, probe_amplitude, component_of_probe},
      {"probe_middle", {"probe", "column", "from", "to", "reference"}, probe_middle, component_of_probe},
      {"front_slope", {"probe", "time_unit", "length_unit", "from", "to", "data"}, front_slope, front_series},
      {"probe_rms", {"probe", "level", "time_unit", "length_unit", "data"}, probe_rms, scalar_series},
      {"probe_deviation", {"probe", "level", "time_unit", "length_unit", "data"}, probe_deviation, scalar_series},
      {"probe_decay", {"probe", "level"}, probe_decay, scalar_series},
      {"probe_decay_rate", {"probe", "level", "reference"}, probe_decay_rate, scalar_series},
      {"probe_growth", {"probe", "level", "from", "to", "reference"}, probe_growth, scalar_series},
      {"probe_difference",
       {"probe", "minus", "column", "from", "to", "reference"},
       probe_difference,
       component_of_probe},
  };
}

}  // namespace seiche
