#include "io/validate_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "io/csv.h"
#include "io/suggest.h"
#include "io/validate_kinds.h"

namespace seiche {
namespace {

using Names = std::vector<std::string>;

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

}  // namespace

void check_names(const MeasureSpec& measure, const Scene& scene, const std::string& where) {
  const MeasureKind& kind = kind_of(measure);
  if (uses(kind, "probe")) check_probe(measure, scene, measure.probe, where);
  if (uses(kind, "minus")) check_probe(measure, scene, measure.minus, where);
  if (uses(kind, "solid")) check_solids(measure, scene, where);
  if (kind.source == MeasureSource::stats && uses(kind, "column"))
    demand(where, "column of stats.csv", measure.column, names_in(stats_header()));
}

std::string unit_of(const MeasureSpec& measure, const Scene& scene) {
  const MeasureKind& kind = kind_of(measure);
  const std::string pattern = kind.unit, word = "column";
  if (!pattern.starts_with(word)) return pattern;
  std::string rest = pattern.substr(word.size());
  if (rest.ends_with(" over unit") && constant(measure.unit) == 1) rest.erase(rest.rfind(" over unit"));
  const std::string unit = unit_of_column(measure, scene, kind.source);
  if (unit.empty() && rest.starts_with("/")) return "1" + rest;
  return unit.empty() ? "" : unit + rest;
}

}  // namespace seiche
