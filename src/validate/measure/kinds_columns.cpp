// Measures of stats.csv and summary.json.
#include <algorithm>

#include "base/error.h"
#include "files/checked_file.h"
#include "files/json.h"
#include "validate/measure/kinds.h"

namespace seiche {
namespace {

Points column_series(const MeasureSpec& spec, const RunPaths& run) {
  const std::string text = read_whole_file(run.stats());
  const std::vector<double> times = csv_column(text, "time"), values = csv_column(text, spec.column);
  Points points;
  for (std::size_t n = 0; n < times.size(); ++n) points.emplace_back(times[n], values[n]);
  return points;
}

Measurement max_of_column(const MeasureSpec& spec, const RunPaths& run) {
  const std::vector<double> values = csv_column(read_whole_file(run.stats()), spec.column);
  if (values.empty()) throw Error(ExitCode::cannot_continue, "stats.csv has no rows");
  double largest = 0;
  for (const double value : values) largest = larger(largest, std::abs(value));
  return {largest, {}, largest};
}

Points::value_type peak_of_column(const MeasureSpec& spec, const RunPaths& run) {
  return peak_during(column_series(spec, run), spec.from, spec.to);
}

double largest_of_column(const MeasureSpec& spec, const RunPaths& run) {
  return std::abs(peak_of_column(spec, run).second) / constant(spec.unit);
}

Measurement column_peak(const MeasureSpec& spec, const RunPaths& run) {
  return itself(largest_of_column(spec, run));
}

Measurement column_extreme(const MeasureSpec& spec, const RunPaths& run) {
  return against(largest_of_column(spec, run), constant(spec.reference));
}

Measurement column_extreme_time(const MeasureSpec& spec, const RunPaths& run) {
  return against(peak_of_column(spec, run).first, constant(spec.reference));
}

Measurement column_drift(const MeasureSpec& spec, const RunPaths& run) {
  const std::vector<double> values = csv_column(read_whole_file(run.stats()), spec.column);
  if (values.empty()) throw Error(ExitCode::cannot_continue, "stats.csv has no rows");
  if (values[0] == 0) throw Error(ExitCode::cannot_continue, "no drift: '" + spec.column + "' is zero at the start");
  double largest = 0;
  for (const double value : values) largest = larger(largest, std::abs(value / values[0] - 1));
  return {largest, {}, largest};
}

// Sum of kinetic and elastic energy, J.
Points energy_series(const MeasureSpec& spec, const RunPaths& run) {
  const std::string text = read_whole_file(run.stats());
  const std::vector<double> elastic = csv_column(text, "elastic_energy");
  MeasureSpec kinetic = spec;
  kinetic.column = "kinetic_energy";
  Points points = column_series(kinetic, run);
  for (std::size_t n = 0; n < points.size(); ++n) points[n].second += elastic[n];
  return points.empty() ? points : points_during(points, spec.from, points.back().first);
}

// Largest rise in one step relative to the initial value; 0 if there is no rise.
Measurement energy_growth(const MeasureSpec& spec, const RunPaths& run) {
  const Points energy = energy_series(spec, run);
  if (energy.size() < 2) throw Error(ExitCode::cannot_continue, "stats.csv has too few rows");
  if (!(energy[0].second > 0)) throw Error(ExitCode::cannot_continue, "there is no energy to begin with");
  double largest = 0;
  for (std::size_t n = 1; n < energy.size(); ++n)
    largest = larger(largest, (energy[n].second - energy[n - 1].second) / energy[0].second);
  return itself(largest);
}

// value/unit over time/time_unit, compared with the data.
Measurement column_rms(const MeasureSpec& spec, const RunPaths& run) {
  Points points = column_series(spec, run);
  const double time_unit = constant(spec.time_unit), unit = constant(spec.unit);
  for (auto& [time, value] : points) time /= time_unit, value /= unit;
  return itself(rms_difference(points, csv_points(read_whole_file(spec.data))));
}

// -d(value/unit)/dt between rows, 1/s.
Points falls(const MeasureSpec& spec, const RunPaths& run) {
  const Points points = column_series(spec, run);
  const double unit = constant(spec.unit);
  Points rates;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const auto [t0, before] = points[n - 1];
    const auto [t1, after] = points[n];
    if (!(t1 > t0)) throw Error(ExitCode::cannot_continue, "the times of stats.csv do not rise");
    rates.emplace_back(0.5 * (t0 + t1), (before - after) / (unit * (t1 - t0)));
  }
  return rates;
}

Points::value_type steepest_fall(const MeasureSpec& spec, const RunPaths& run) {
  return highest_during(falls(spec, run), spec.from, spec.to);
}

Measurement column_fall(const MeasureSpec& spec, const RunPaths& run) {
  return against(steepest_fall(spec, run).second, constant(spec.reference));
}

Measurement column_fall_time(const MeasureSpec& spec, const RunPaths& run) {
  return against(steepest_fall(spec, run).first, constant(spec.reference));
}

Measurement volume_drift_of_run(const MeasureSpec&, const RunPaths& run) {
  const auto drift = json_number(read_whole_file(run.summary()), "volume_drift");
  if (!drift) throw Error(ExitCode::cannot_continue, "summary.json holds no volume_drift");
  return {*drift, {}, std::abs(*drift)};
}

}  // namespace

std::vector<MeasureKind> measures_of_columns() {
  return {
      {"max_of_column", {"column"}, max_of_column, column_series},
      {"column_peak", {"column", "from", "to", "unit"}, column_peak, column_series},
      {"column_extreme", {"column", "from", "to", "unit", "reference"}, column_extreme, column_series},
      {"column_extreme_time", {"column", "from", "to", "reference"}, column_extreme_time, column_series},
      {"column_drift", {"column"}, column_drift, column_series},
      {"column_rms", {"column", "time_unit", "unit", "data"}, column_rms, column_series},
      {"column_fall", {"column", "from", "to", "unit", "reference"}, column_fall, falls},
      {"column_fall_time", {"column", "from", "to", "reference"}, column_fall_time, falls},
      {"energy_growth", {"from"}, energy_growth, energy_series},
      {"volume_drift", {}, volume_drift_of_run},
  };
}

}  // namespace seiche
