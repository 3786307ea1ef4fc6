#include "validate/measure/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "base/error.h"
#include "base/scene.h"
#include "validate/measure/kinds.h"

namespace seiche {
namespace {

struct KindWords {
  const char* kind;
  const char* unit;  // of the figure; "column": unit of the measured column; "": dimensionless
  const char* what;
};

constexpr KindWords frame_and_probe_words[] = {
    {"vector_l2", "m/s", "L2 norm of the last frame's face velocities less the exact ones"},
    {"region_l2", "m/s", "L2 norm of the last frame's face velocities in a region less the exact ones"},
    {"region_max", "m/s", "largest difference of the last frame's face velocities in a region from the exact ones"},
    {"line_extrema", "", "worst relative error of extreme velocities along lines, in the last frame"},
    {"line_extrema_places", "m",
     "worst distance of extreme velocities along lines from their places, in the last frame"},
    {"stream_function_extreme", "m^2/s", "largest magnitude of the last frame's stream function"},
    {"line_deviation", "m/s", "largest difference from a profile of velocities along lines, in the last frame"},
    {"surface_deviation", "", "largest distance of the last frame's surface from the exact one, over length_unit"},
    {"circularity", "", "least circularity of the frames in a time"},
    {"circularity_time", "s", "when the circularity of the frames is least in a time, by a parabola through three"},
    {"surface_misplaced", "", "area (3D: volume) on the wrong side of the exact surface in the last frame, over unit"},
    {"period_of_probe", "s", "mean of a probe's whole periods about level"},
    {"probe_period", "s", "mean of a probe's whole periods about level in a time"},
    {"probe_period_scatter", "",
     "standard deviation of a probe's whole periods about level in a time, over their mean"},
    {"probe_mean", "column", "mean of a probe in a time, weighted with sin^2"},
    {"probe_peak", "column", "a probe's value of the largest magnitude in a time"},
    {"probe_peak_time", "s", "when a probe has its largest magnitude in a time"},
    {"impact_peak", "Pa", "largest pressure of a probe in a time, 0 where it is dry"},
    {"impact_peak_time", "s", "when the pressure of a probe is largest in a time, 0 where it is dry"},
    {"probe_arrival", "s", "when a probe first has a value"},
    {"probe_amplitude", "column", "half the difference of a probe's extremes in a time"},
    {"probe_middle", "column", "half the sum of a probe's extremes in a time"},
    {"front_slope", "", "speed of a front, length/length_unit over time/time_unit, between two lengths"},
    {"probe_rms", "", "root mean square of (value - level)/length_unit less the data"},
    {"probe_deviation", "", "largest magnitude of (value - level)/length_unit less the data"},
    {"probe_decay", "1/s", "rate at which the energy of a probe's swing about level dies away"},
    {"probe_decay_rate", "1/s", "rate at which the energy of a probe's swing about level dies away"},
    {"probe_growth", "1/s", "rate at which a probe's distance from level grows in a time"},
    {"probe_difference", "column", "mean of a probe in a time, weighted with sin^2, less that of another"},
};

// Measures of stats.csv, summary.json and solids.csv.
constexpr KindWords table_words[] = {
    {"max_of_column", "column", "largest magnitude in a column of stats.csv"},
    {"column_peak", "column over unit", "largest magnitude in a column of stats.csv in a time, over unit"},
    {"column_extreme", "column over unit", "largest magnitude in a column of stats.csv in a time, over unit"},
    {"column_extreme_time", "s", "when a column of stats.csv has its largest magnitude in a time"},
    {"column_drift", "", "largest change of a column of stats.csv from its first row, over that"},
    {"column_rms", "", "root mean square of a column of stats.csv over unit less the data"},
    {"column_fall", "column/s over unit", "fastest fall of a column of stats.csv between steps in a time, over unit"},
    {"column_fall_time", "s", "when a column of stats.csv falls fastest in a time"},
    {"energy_growth", "", "largest rise of kinetic and elastic energy in a step, over what they were at from"},
    {"volume_drift", "", "drift of the liquid's volume over the run, relative"},
    {"solid_mean", "column", "mean of a solid's column in a time, weighted with sin^2"},
    {"solid_slope", "column/s", "least-squares slope of a solid's column in a time"},
    {"solid_peak", "column", "a solid's value of the largest magnitude in a time"},
    {"solid_period", "s", "mean of a solid's whole periods about level in a time"},
    {"solid_amplitude", "column", "half the difference of a solid's extremes in a time"},
    {"solid_middle", "column", "half the sum of a solid's extremes in a time"},
    {"solid_rms", "", "root mean square of (value - level)/length_unit less the data"},
    {"solid_root_mean_square", "column", "root mean square of a solid's column in a time"},
    {"solids_stray", "", "farthest way of any solid from where it is at from, over length_unit"},
};

// Throws Error(bug) if a kind has no row.
const KindWords& words_of(const MeasureSpec& m) {
  for (const std::span<const KindWords> words : {std::span<const KindWords>(frame_and_probe_words), {table_words}})
    for (const KindWords& row : words)
      if (m.kind == row.kind) return row;
  throw Error(ExitCode::bug, fmt::format("no words for the measure '{}'", m.kind));
}

struct UnitRow {
  const char* column;
  std::array<const char*, 2> unit;  // in 2D and 3D
};

constexpr UnitRow stats_units[] = {{"time", {"s", "s"}},
                                   {"dt", {"s", "s"}},
                                   {"wall_seconds", {"s", "s"}},
                                   {"liquid_volume", {"m^2", "m^3"}},
                                   {"volume_corrected", {"m^2", "m^3"}},
                                   {"gas_volume", {"m^2", "m^3"}},
                                   {"air_lost", {"m^2", "m^3"}},
                                   {"kinetic_energy", {"J/m", "J"}},
                                   {"potential_energy", {"J/m", "J"}},
                                   {"elastic_energy", {"J/m", "J"}},
                                   {"momentum_x", {"kg/s", "kg m/s"}},
                                   {"momentum_y", {"kg/s", "kg m/s"}},
                                   {"momentum_z", {"kg/s", "kg m/s"}},
                                   {"max_speed", {"m/s", "m/s"}},
                                   {"max_divergence", {"1/s", "1/s"}}};

// Units by the first letter of a column of solids.csv, after a leading "pin_".
constexpr UnitRow solids_units[] = {
    {"xyz", {"m", "m"}}, {"v", {"m/s", "m/s"}}, {"w", {"1/s", "1/s"}}, {"f", {"N/m", "N"}}, {"t", {"N", "N m"}}};

// 2D: per metre of depth.
std::string unit_of_joint(const ProbeSpec& probe, const Scene& scene) {
  const bool flat = scene.dimension == 2;
  switch (probe.quantity) {
    case JointQuantity::force:
      return flat ? "N/m" : "N";
    case JointQuantity::torque:
      return flat ? "N" : "N m";
    case JointQuantity::power:
      return flat ? "W/m" : "W";
    case JointQuantity::coordinate:
      break;
  }
  const auto joint = std::ranges::find(scene.joints, probe.joint, &JointSpec::name);
  return joint != scene.joints.end() && joint->kind == JointKind::hinge ? "rad" : "m";
}

std::string unit_of_probe(const MeasureSpec& m, const Scene& scene) {
  const auto probe = std::ranges::find(scene.probes, m.probe, &ProbeSpec::name);
  if (probe == scene.probes.end()) return {};
  if (probe->kind == ProbeKind::joint) return unit_of_joint(*probe, scene);
  return probe->kind == ProbeKind::pressure ? "Pa" : probe->kind == ProbeKind::velocity ? "m/s" : "m";
}

std::string unit_of_column(const MeasureSpec& m, const Scene& scene, MeasureSource source) {
  const auto dimension = std::size_t(scene.dimension - 2);
  if (source == MeasureSource::probes) return unit_of_probe(m, scene);
  if (source == MeasureSource::stats) {
    const auto row = std::ranges::find_if(stats_units, [&](const UnitRow& one) { return m.column == one.column; });
    return row == std::end(stats_units) ? "" : row->unit[dimension];
  }
  const std::string column = m.column.starts_with("pin_") ? m.column.substr(4) : m.column;
  const auto row = std::ranges::find_if(solids_units, [&](const UnitRow& one) {
    return !column.empty() && std::string(one.column).find(column[0]) != std::string::npos;
  });
  return row == std::end(solids_units) ? "" : row->unit[dimension];
}

}  // namespace

std::string what_is_measured(const MeasureSpec& measure) {
  return words_of(measure).what;
}

std::string error_in_words(const MeasureSpec& measure) {
  const MeasureKind& kind = kind_of(measure);
  if (!uses(kind, "reference")) return measure.kind == "front_slope" ? "relative to that of the data" : "the figure";
  if (measure.kind == "circularity") return "difference from the reference";
  return measure.kind == "solid_mean" ? "difference from the reference over length_unit" : "relative to the reference";
}

std::string unit_of(const MeasureSpec& measure, const Scene& scene) {
  const MeasureKind& kind = kind_of(measure);
  const std::string pattern = words_of(measure).unit, word = "column";
  if (!pattern.starts_with(word)) return pattern;
  std::string rest = pattern.substr(word.size());
  if (rest.ends_with(" over unit") && constant(measure.unit) == 1) rest.erase(rest.rfind(" over unit"));
  const std::string unit = unit_of_column(measure, scene, kind.source);
  if (unit.empty() && rest.starts_with("/")) return "1" + rest;
  if (unit == "m/s" && rest == "/s") return "m/s^2";
  return unit.empty() ? "" : unit + rest;
}

}  // namespace seiche
