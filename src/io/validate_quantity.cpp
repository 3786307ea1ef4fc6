#include "io/validate_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "base/error.h"
#include "io/checked_file.h"
#include "io/csv.h"
#include "io/suggest.h"
#include "io/validate_kinds.h"
#include "io/validate_lines.h"

namespace seiche {
namespace {

using Names = std::vector<std::string>;

struct KindWords {
  const char* kind;
  const char* unit;  // of the figure; "column": that of what is measured; "": a pure number
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

// Of stats.csv, summary.json and solids.csv.
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

// Throws Error(bug) where a kind has no row.
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

// By the first letter of a column of solids.csv.
constexpr UnitRow solids_units[] = {
    {"xyz", {"m", "m"}}, {"v", {"m/s", "m/s"}}, {"w", {"1/s", "1/s"}}, {"f", {"N/m", "N"}}, {"t", {"N", "N m"}}};

// "time,name\n" -> time, name
Names names_in(const std::string& header) {
  Names names;
  for (std::size_t at = 0; at < header.size();) {
    const std::size_t end = std::min(header.find_first_of(",\n", at), header.size());
    if (end > at) names.push_back(header.substr(at, end - at));
    at = end + 1;
  }
  return names;
}

Names probe_names(const Scene& scene) {
  Names names;
  for (const ProbeSpec& probe : scene.probes) names.push_back(probe.name);
  return names;
}

Names solid_names(const Scene& scene) {
  Names names;
  for (const SolidSpec& solid : scene.solids) names.push_back(solid.name);
  return names;
}

// "a + b" -> a, b
Names parts_of_sum(const std::string& solids) {
  constexpr std::string_view plus = " + ";
  Names parts;
  for (std::size_t at = 0; at <= solids.size();) {
    const std::size_t end = std::min(solids.find(plus, at), solids.size());
    parts.push_back(solids.substr(at, end - at));
    at = end + plus.size();
  }
  return parts;
}

void demand(const std::string& where, const std::string& what, const std::string& name, const Names& known) {
  if (std::ranges::count(known, name) > 0) return;
  const auto near = suggest(name, known);
  const std::string help = near            ? fmt::format("did you mean '{}'?", *near)
                           : known.empty() ? std::string("there is none at all")
                                           : fmt::format("there are: {}", fmt::join(known, ", "));
  throw Error(ExitCode::bad_input, fmt::format("{}: there is no {} '{}'; {}", where, what, name, help));
}

const ProbeSpec* probe_named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.probes, name, &ProbeSpec::name);
  return found == scene.probes.end() ? nullptr : &*found;
}

bool is_vector(const ProbeSpec& probe) {
  return probe.kind == ProbeKind::velocity || probe.kind == ProbeKind::displacement;
}

void check_probe(const MeasureSpec& m, const Scene& scene, const std::string& name, const std::string& where) {
  demand(where, "probe", name, probe_names(scene));
  if (m.kind.starts_with("impact_") && probe_named(scene, name)->kind != ProbeKind::pressure)
    throw Error(ExitCode::bad_input, fmt::format("{}: probe '{}' is to measure pressure for {}", where, name, m.kind));
  const std::string column = uses(kind_of(m), "column") ? m.column : "value";
  const Names known = is_vector(*probe_named(scene, name)) ? Names{"x", "y", "z"} : Names{"value"};
  demand(where, fmt::format("column of probe '{}'", name), column, known);
}

void check_solids(const MeasureSpec& m, const Scene& scene, const std::string& where) {
  for (const std::string& name : parts_of_sum(m.solid)) demand(where, "solid", name, solid_names(scene));
  Names known = names_in(solids_header());
  std::erase(known, "name");
  demand(where, "column of solids.csv", m.column, known);
}

std::string unit_of_probe(const MeasureSpec& m, const Scene& scene) {
  const ProbeSpec* probe = probe_named(scene, m.probe);
  if (!probe) return {};
  return probe->kind == ProbeKind::pressure ? "Pa" : probe->kind == ProbeKind::velocity ? "m/s" : "m";
}

std::string unit_of_column(const MeasureSpec& m, const Scene& scene, MeasureSource source) {
  const auto dimension = std::size_t(scene.dimension - 2);
  if (source == MeasureSource::probes) return unit_of_probe(m, scene);
  if (source == MeasureSource::stats) {
    const auto row = std::ranges::find_if(stats_units, [&](const UnitRow& one) { return m.column == one.column; });
    return row == std::end(stats_units) ? "" : row->unit[dimension];
  }
  const auto row = std::ranges::find_if(solids_units, [&](const UnitRow& one) {
    return !m.column.empty() && std::string(one.column).find(m.column[0]) != std::string::npos;
  });
  return row == std::end(solids_units) ? "" : row->unit[dimension];
}

// Reads the data as the measure is going to.
void check_data(const MeasureSpec& m, const std::string& where) {
  try {
    const std::string text = read_whole_file(m.data);
    if (m.kind == "line_deviation")
      csv_profile(text);
    else if (m.kind.starts_with("line_extrema"))
      csv_extremes(text);
    else if (csv_points(text).size() < 2)
      throw Error(ExitCode::bad_input, "less than two rows to compare with");
  } catch (const Error& error) {
    throw Error(ExitCode::bad_input, fmt::format("{}: {}: {}", where, m.data.string(), error.what()));
  }
}

}  // namespace

void check_measure(const MeasureSpec& measure, const Scene& scene, const std::string& where) {
  const MeasureKind& kind = kind_of(measure);
  if (uses(kind, "probe")) check_probe(measure, scene, measure.probe, where);
  if (uses(kind, "minus")) check_probe(measure, scene, measure.minus, where);
  if (uses(kind, "solid")) check_solids(measure, scene, where);
  if (kind.source == MeasureSource::stats && uses(kind, "column"))
    demand(where, "column of stats.csv", measure.column, names_in(stats_header()));
  if (uses(kind, "data")) check_data(measure, where);
}

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
