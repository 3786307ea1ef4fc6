#include "io/validate_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "io/checked_file.h"
#include "io/frames.h"
#include "io/info.h"
#include "io/validate_contour.h"
#include "io/validate_frames.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

using T = OptionType;

Measurement against(double value, double reference) {
  return {value, reference, std::abs(value / reference - 1)};
}

vdb::Frame last_frame(const RunPaths& run) {
  fs::path last;
  for (const auto& entry : fs::directory_iterator(run.frames())) {
    if (entry.path().extension() == ".vdb") last = std::max(last, entry.path());
  }
  return vdb::decode(last);
}

Measurement itself(double error) {
  return {error, {}, error};
}

// Of the frames, by their times.
Points circularities(const MeasureSpec&, const RunPaths& run) {
  Points points;
  for (const auto& entry : fs::directory_iterator(run.frames())) {
    if (entry.path().extension() != ".vdb") continue;
    const vdb::Frame frame = vdb::decode(entry.path());
    points.emplace_back(frame.time, circularity(frame));
  }
  std::sort(points.begin(), points.end());
  return points;
}

Measurement least_circularity(const MeasureSpec& spec, const RunPaths& run) {
  double least = 1;
  for (const auto& [time, value] : points_during(circularities(spec, run), spec.from, spec.to))
    least = std::min(least, value);
  const double reference = constant(spec.reference);
  return {least, reference, std::abs(least - reference)};
}

Measurement vector_l2(const MeasureSpec& spec, const RunPaths& run) {
  return itself(velocity_difference(last_frame(run), spec.velocity, "-1"));
}

Measurement region_l2(const MeasureSpec& spec, const RunPaths& run) {
  return itself(velocity_difference(last_frame(run), spec.velocity, spec.region));
}

Measurement line_extrema(const MeasureSpec& spec, const RunPaths& run) {
  const vdb::Frame frame = last_frame(run);
  double worst = 0;
  for (const LineExtreme& line : csv_lines(read_whole_file(spec.data)))
    worst = std::max(worst, std::abs(extreme_along(frame, line) / line.value - 1));
  return itself(worst);
}

Measurement surface_deviation(const MeasureSpec& spec, const RunPaths& run) {
  return itself(surface_difference(last_frame(run), spec.surface) / constant(spec.length_unit));
}

Measurement misplaced(const MeasureSpec& spec, const RunPaths& run) {
  return itself(surface_misplaced(last_frame(run), spec.surface) / constant(spec.unit));
}

Measurement period_of_probe(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = probe_points(read_whole_file(run.probes()), spec.probe);
  return against(mean_period(points, constant(spec.level)), constant(spec.reference));
}

Points component_of_probe(const MeasureSpec& spec, const RunPaths& run) {
  return probe_points(read_whole_file(run.probes()), spec.probe, spec.column);
}

Measurement probe_period(const MeasureSpec& spec, const RunPaths& run) {
  return against(mean_period(component_of_probe(spec, run), constant(spec.level)), constant(spec.reference));
}

Measurement probe_mean(const MeasureSpec& spec, const RunPaths& run) {
  return against(settled_mean(component_of_probe(spec, run), spec.from, spec.to), constant(spec.reference));
}

// Largest and smallest value from `from` to `to`.
std::pair<double, double> extremes(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = points_during(component_of_probe(spec, run), spec.from, spec.to);
  std::pair<double, double> found{points.at(0).second, points[0].second};
  for (const auto& [time, value] : points) found = {std::min(found.first, value), std::max(found.second, value)};
  return found;
}

Measurement probe_peak(const MeasureSpec& spec, const RunPaths& run) {
  const auto [low, high] = extremes(spec, run);
  return against(std::abs(low) > std::abs(high) ? low : high, constant(spec.reference));
}

// When that is, in s.
Measurement probe_peak_time(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = points_during(component_of_probe(spec, run), spec.from, spec.to);
  const auto peak = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::abs(a.second) < std::abs(b.second);
  });
  return against(peak->first, constant(spec.reference));
}

Points scalar_series(const MeasureSpec& spec, const RunPaths& run) {
  return probe_points(read_whole_file(run.probes()), spec.probe);
}

// When the probe first has a value, in s.
Measurement probe_arrival(const MeasureSpec& spec, const RunPaths& run) {
  return against(scalar_series(spec, run).front().first, constant(spec.reference));
}

// Half the way between the extremes.
Measurement probe_amplitude(const MeasureSpec& spec, const RunPaths& run) {
  const auto [low, high] = extremes(spec, run);
  return against(0.5 * (high - low), constant(spec.reference));
}

Points front_series(const MeasureSpec& spec, const RunPaths& run) {
  Points points = probe_points(read_whole_file(run.probes()), spec.probe);
  const double time_unit = constant(spec.time_unit), length_unit = constant(spec.length_unit);
  for (auto& [time, length] : points) time /= time_unit, length /= length_unit;
  return points;
}

Points column_series(const MeasureSpec& spec, const RunPaths& run) {
  const std::string text = read_whole_file(run.stats());
  const std::vector<double> times = csv_column(text, "time"), values = csv_column(text, spec.column);
  Points points;
  for (std::size_t n = 0; n < times.size(); ++n) points.emplace_back(times[n], values[n]);
  return points;
}

Points solid_series(const MeasureSpec& spec, const RunPaths& run) {
  return solid_points(read_whole_file(run.solids()), spec.solid, spec.column);
}

Measurement front_slope(const MeasureSpec& spec, const RunPaths& run) {
  return against(slope_between(front_series(spec, run), spec.from, spec.to),
                 slope_between(csv_points(read_whole_file(spec.data)), spec.from, spec.to));
}

Measurement max_of_column(const MeasureSpec& spec, const RunPaths& run) {
  const std::vector<double> values = csv_column(read_whole_file(run.stats()), spec.column);
  if (values.empty()) throw Error(ExitCode::cannot_continue, "stats.csv has no rows");
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return {largest, {}, largest};
}

// The largest magnitude over from <= t <= to.
double largest_of_column(const MeasureSpec& spec, const RunPaths& run) {
  const std::string text = read_whole_file(run.stats());
  const std::vector<double> times = csv_column(text, "time"), values = csv_column(text, spec.column);
  Points points;
  for (std::size_t n = 0; n < times.size(); ++n) points.emplace_back(times[n], values[n]);
  double largest = 0;
  for (const auto& [time, value] : points_during(points, spec.from, spec.to))
    largest = std::max(largest, std::abs(value));
  return largest / constant(spec.unit);
}

Measurement column_peak(const MeasureSpec& spec, const RunPaths& run) {
  return itself(largest_of_column(spec, run));
}

Measurement column_extreme(const MeasureSpec& spec, const RunPaths& run) {
  return against(largest_of_column(spec, run), constant(spec.reference));
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

// Of two probes' settled means.
Measurement probe_difference(const MeasureSpec& spec, const RunPaths& run) {
  const std::string text = read_whole_file(run.probes());
  const auto mean = [&](const std::string& probe) {
    return settled_mean(probe_points(text, probe, spec.column), spec.from, spec.to);
  };
  return against(mean(spec.probe) - mean(spec.minus), constant(spec.reference));
}

Measurement probe_decay(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = probe_points(read_whole_file(run.probes()), spec.probe);
  return itself(std::abs(energy_decay(points, constant(spec.level))));
}

// Mean over from <= t <= to, weighted so that oscillations leave next to nothing.
Measurement solid_mean(const MeasureSpec& spec, const RunPaths& run) {
  const double mean =
      settled_mean(solid_points(read_whole_file(run.solids()), spec.solid, spec.column), spec.from, spec.to);
  const double reference = constant(spec.reference);
  return {mean, reference, std::abs(mean - reference) / constant(spec.length_unit)};
}

// Least-squares slope over from <= t <= to.
Measurement solid_slope(const MeasureSpec& spec, const RunPaths& run) {
  const Points all = solid_points(read_whole_file(run.solids()), spec.solid, spec.column);
  return against(slope_during(all, spec.from, spec.to), constant(spec.reference));
}

Points solid_during(const MeasureSpec& spec, const RunPaths& run) {
  return points_during(solid_points(read_whole_file(run.solids()), spec.solid, spec.column), spec.from, spec.to);
}

Measurement solid_peak(const MeasureSpec& spec, const RunPaths& run) {
  double peak = 0;
  for (const auto& [time, value] : solid_during(spec, run))
    if (std::abs(value) > std::abs(peak)) peak = value;
  return against(peak, constant(spec.reference));
}

Measurement solid_period(const MeasureSpec& spec, const RunPaths& run) {
  return against(mean_period(solid_during(spec, run), constant(spec.level)), constant(spec.reference));
}

Measurement solids_stray(const MeasureSpec& spec, const RunPaths& run) {
  const double way = farthest_stray(read_whole_file(run.solids()), spec.from) / constant(spec.length_unit);
  return {way, {}, way};
}

Measurement column_drift(const MeasureSpec& spec, const RunPaths& run) {
  const std::vector<double> values = csv_column(read_whole_file(run.stats()), spec.column);
  if (values.empty()) throw Error(ExitCode::cannot_continue, "stats.csv has no rows");
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value / values[0] - 1));
  return {largest, {}, largest};
}

Measurement volume_drift_of_run(const MeasureSpec&, const RunPaths& run) {
  const std::string text = json_value(read_whole_file(run.summary()), "volume_drift");
  char* end = nullptr;
  const double drift = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) throw Error(ExitCode::cannot_continue, "summary.json holds no volume_drift");
  return {drift, {}, std::abs(drift)};
}

struct MeasureKind {
  const char* name;
  std::vector<const char*> keys;  // of [measure], all required
  Measurement (*measure)(const MeasureSpec&, const RunPaths&);
  Points (*series)(const MeasureSpec&, const RunPaths&) = nullptr;
};

const std::vector<MeasureKind>& kinds() {
  static const std::vector<MeasureKind> table{
      {"vector_l2", {"velocity"}, vector_l2},
      {"region_l2", {"velocity", "region"}, region_l2},
      {"line_extrema", {"data"}, line_extrema},
      {"surface_deviation", {"surface", "length_unit"}, surface_deviation},
      {"circularity", {"from", "to", "reference"}, least_circularity, circularities},
      {"surface_misplaced", {"surface", "unit"}, misplaced},
      {"period_of_probe", {"probe", "level", "reference"}, period_of_probe, scalar_series},
      {"probe_period", {"probe", "column", "level", "reference"}, probe_period, component_of_probe},
      {"probe_mean", {"probe", "column", "from", "to", "reference"}, probe_mean, component_of_probe},
      {"probe_peak", {"probe", "column", "from", "to", "reference"}, probe_peak, component_of_probe},
      {"probe_peak_time", {"probe", "column", "from", "to", "reference"}, probe_peak_time, component_of_probe},
      {"probe_arrival", {"probe", "reference"}, probe_arrival, scalar_series},
      {"probe_amplitude", {"probe", "column", "from", "to", "reference"}, probe_amplitude, component_of_probe},
      {"front_slope", {"probe", "time_unit", "length_unit", "from", "to", "data"}, front_slope, front_series},
      {"max_of_column", {"column"}, max_of_column, column_series},
      {"column_peak", {"column", "from", "to", "unit"}, column_peak, column_series},
      {"column_extreme", {"column", "from", "to", "unit", "reference"}, column_extreme, column_series},
      {"column_drift", {"column"}, column_drift, column_series},
      {"probe_rms", {"probe", "level", "time_unit", "length_unit", "data"}, probe_rms, scalar_series},
      {"probe_deviation", {"probe", "level", "time_unit", "length_unit", "data"}, probe_deviation, scalar_series},
      {"probe_decay", {"probe", "level"}, probe_decay, scalar_series},
      {"probe_growth", {"probe", "level", "from", "to", "reference"}, probe_growth, scalar_series},
      {"probe_difference",
       {"probe", "minus", "column", "from", "to", "reference"},
       probe_difference,
       component_of_probe},
      {"volume_drift", {}, volume_drift_of_run},
      {"solid_mean", {"solid", "column", "from", "to", "reference", "length_unit"}, solid_mean, solid_series},
      {"solid_slope", {"solid", "column", "from", "to", "reference"}, solid_slope, solid_series},
      {"solid_peak", {"solid", "column", "from", "to", "reference"}, solid_peak, solid_series},
      {"solid_period", {"solid", "column", "level", "from", "to", "reference"}, solid_period, solid_series},
      {"solids_stray", {"from", "length_unit"}, solids_stray},
  };
  return table;
}

const MeasureKind& kind_of(const MeasureSpec& spec) {
  const auto kind =
      std::find_if(kinds().begin(), kinds().end(), [&](const MeasureKind& row) { return row.name == spec.kind; });
  if (kind == kinds().end()) throw Error(ExitCode::bug, fmt::format("no measure is named '{}'", spec.kind));
  return *kind;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const MeasureKind& kind : kinds()) names.emplace_back(kind.name);
  return names;
}

// Binds a key to the kinds that the table gives it.
template <class Member>
Key<MeasureSpec> parameter(Option option, Member member) {
  option.only_for.key = "kind";
  option.presence = Presence::required;
  for (const MeasureKind& kind : kinds()) {
    const auto uses = [&](const char* key) { return option.key == key; };
    if (std::any_of(kind.keys.begin(), kind.keys.end(), uses)) option.only_for.values.emplace_back(kind.name);
  }
  return value_key<MeasureSpec>(option, member);
}

}  // namespace

Points measured_series(const MeasureSpec& spec, const RunPaths& run) {
  const MeasureKind& kind = kind_of(spec);
  return kind.series ? kind.series(spec, run) : Points();
}

Section<MeasureSpec> measure_section() {
  using S = MeasureSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "kind", .type = T::choice, .choices = kind_names(), .presence = Presence::required},
                   &S::kind),
      parameter({.key = "velocity", .type = T::formula_vector, .unit = "m/s", .variables = "xyzt"}, &S::velocity),
      parameter({.key = "region", .type = T::formula, .variables = "xyzt"}, &S::region),
      parameter({.key = "surface", .type = T::formula, .unit = "m", .variables = "xyzt"}, &S::surface),
      parameter({.key = "probe", .type = T::text}, &S::probe),
      parameter({.key = "minus", .type = T::text}, &S::minus),
      parameter({.key = "column", .type = T::text}, &S::column),
      parameter({.key = "solid", .type = T::text}, &S::solid),
      parameter({.key = "level", .type = T::formula}, &S::level),
      parameter({.key = "reference", .type = T::formula}, &S::reference),
      parameter({.key = "time_unit", .type = T::formula, .unit = "s", .range = positive()}, &S::time_unit),
      parameter({.key = "length_unit", .type = T::formula, .unit = "m", .range = positive()}, &S::length_unit),
      parameter({.key = "unit", .type = T::formula}, &S::unit),
      parameter({.key = "from"}, &S::from),
      parameter({.key = "to"}, &S::to),
      parameter({.key = "data", .type = T::file}, &S::data),
  };
  return s;
}

double constant(const Formula& formula) {
  return Expression(formula)(Vec3(0, 0, 0), 0);
}

Measurement measure(const MeasureSpec& spec, const RunPaths& run) {
  try {
    const Measurement result = kind_of(spec).measure(spec, run);
    if (std::isfinite(result.error)) return result;
  } catch (const Error& error) {  // whatever was missing or unreadable, the run is not measured
    throw Error(ExitCode::cannot_continue, error.what());
  } catch (const fs::filesystem_error& error) {
    throw Error(ExitCode::cannot_continue, error.what());
  }
  throw Error(ExitCode::cannot_continue, fmt::format("{} is not a number", spec.kind));
}

}  // namespace seiche
