#include "validate/case/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/scene.h"
#include "base/suggest.h"
#include "files/checked_file.h"
#include "files/csv.h"
#include "validate/measure/kinds.h"
#include "validate/measure/lines.h"
#include "validate/measure/quantity.h"

namespace seiche {
namespace fs = std::filesystem;
namespace {

using Names = std::vector<std::string>;

constexpr std::string_view front = "front_slope";  // compares slopes: its bounds are lengths, its data of any time

// Column names from a table's first line.
Names columns_of(const std::string& header) {
  return csv_rows(header).at(0);
}

template <class Named>
Names names_of(const std::vector<Named>& all) {
  Names names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

void demand(const std::string& where, const std::string& what, const std::string& name, const Names& known) {
  if (std::ranges::count(known, name) > 0) return;
  const auto near = suggest(name, known);
  const std::string help = near            ? fmt::format("did you mean '{}'?", *near)
                           : known.empty() ? std::string("there is none at all")
                                           : fmt::format("there are: {}", fmt::join(known, ", "));
  throw Error(ExitCode::bad_input, fmt::format("{}: there is no {} '{}'; {}", where, what, name, help));
}

void check_probe(const MeasureSpec& m, const Scene& scene, const std::string& name, const std::string& where) {
  demand(where, "probe", name, names_of(scene.probes));
  const ProbeSpec& probe = *std::ranges::find(scene.probes, name, &ProbeSpec::name);
  if (m.kind.starts_with("impact_") && probe.kind != ProbeKind::pressure)
    throw Error(ExitCode::bad_input, fmt::format("{}: probe '{}' is to measure pressure for {}", where, name, m.kind));
  const std::string column = uses(kind_of(m), "column") ? m.column : "value";
  const Names known = probe.is_vector() ? Names{"x", "y", "z"} : Names{"value"};
  demand(where, fmt::format("column of probe '{}'", name), column, known);
}

void check_solids(const MeasureSpec& m, const Scene& scene, const std::string& where) {
  for (const std::string& name : parts_of_sum(m.solid)) demand(where, "solid", name, names_of(scene.solids));
  Names known = columns_of(solids_header());
  std::erase(known, "name");
  demand(where, "column of solids.csv", m.column, known);
}

// True if a point (m) lies in the domain, ignoring the axis `but` (-1: none).
bool lies_in(const DomainSpec& domain, int dimension, const Vec3& x, int but) {
  for (int a = 0; a < dimension; ++a) {
    const double slack = 1e-9 * (domain.upper[a] - domain.lower[a]);
    if (a != but && (x[a] < domain.lower[a] - slack || x[a] > domain.upper[a] + slack)) return false;
  }
  return true;
}

// The position of a line along itself is unused; a point uses all its coordinates.
int free_axis(const LineExtreme& line) {
  return line.along;
}

int free_axis(const LinePoint&) {
  return -1;
}

// Checks lines of velocities that measures sample.
template <class Line>
void check_lines(const std::vector<Line>& lines, const Scene& scene) {
  for (const Line& line : lines) {
    if (std::max(line.component, line.along) >= scene.dimension)
      throw Error(ExitCode::bad_input, "z is no axis of a 2D scene");
    if (!lies_in(scene.domain, scene.dimension, line.point, free_axis(line)))
      throw Error(ExitCode::bad_input, fmt::format("({:g}, {:g}, {:g}) lies outside of the domain", line.point[0],
                                                   line.point[1], line.point[2]));
  }
}

void check_values(const std::vector<LineExtreme>& lines) {
  if (std::ranges::count(lines, 0.0, &LineExtreme::value) > 0)
    throw Error(ExitCode::bad_input, "a value is zero, and errors are relative to it");
}

// Requires at least two rows with ascending times; digitised curves may have vertical parts.
Points checked_series(const std::string& text) {
  const Points points = csv_points(text);
  if (points.size() < 2) throw Error(ExitCode::bad_input, "less than two rows to compare with");
  for (std::size_t n = 1; n < points.size(); ++n)
    if (points[n].first < points[n - 1].first)
      throw Error(ExitCode::bad_input,
                  fmt::format("the first column goes back, from {:g} to {:g}", points[n - 1].first, points[n].first));
  return points;
}

// check(text of the file); errors get the names of the case and of the file as prefix.
template <class Check>
void check_file(const fs::path& file, const std::string& where, const Check& check) {
  try {
    check(read_whole_file(file));
  } catch (const Error& error) {
    throw Error(ExitCode::bad_input, fmt::format("{}: {}: {}", where, file.string(), error.what()));
  }
}

// `what` starts the message.
void check_reach(const std::string& what, double last, const Scene& scene) {
  if (last > scene.time.end * (1 + 1e-9))
    throw Error(ExitCode::bad_input,
                fmt::format("{}{:g} s lies beyond the scene's end, {:g} s", what, last, scene.time.end));
}

// Reads the data as the measure will do.
void check_data(const MeasureSpec& m, const Scene& scene, const std::string& where) {
  check_file(m.data, where, [&](const std::string& text) {
    if (m.kind == "line_deviation") {
      check_lines(csv_profile(text), scene);
    } else if (m.kind.starts_with("line_extrema")) {
      const std::vector<LineExtreme> lines = csv_extremes(text);
      check_lines(lines, scene);
      if (m.kind == "line_extrema") check_values(lines);
    } else {
      const double last = checked_series(text).back().first;
      if (m.kind != front) check_reach("", last * constant(m.time_unit), scene);
    }
  });
}

// Checks the interval of time that is compared.
void check_times(const MeasureSpec& m, const Scene& scene, const std::string& where) {
  if (!(m.from < m.to)) throw Error(ExitCode::bad_input, fmt::format("{}: from must be below to", where));
  if (m.kind != front) check_reach(where + ": to: ", m.to, scene);
}

// Checks that frames contain the fields that the measure reads.
void check_frames(const MeasureSpec& m, const Scene& scene, const std::string& where) {
  const bool of_surface = uses(kind_of(m), "surface") || m.kind.starts_with("circularity");
  demand(where + ": for " + m.kind, "field in output.frames", of_surface ? "surface" : "velocity", scene.output.frames);
}

// Checks a divisor of errors.
void check_divisor(const char* key, const Formula& formula, const std::string& where) {
  const double value = constant(formula);
  if (value == 0 || !std::isfinite(value))
    throw Error(ExitCode::bad_input, fmt::format("{}: {} is {:g}, and errors are over it", where, key, value));
}

}  // namespace

void check_measure(const MeasureSpec& measure, const Scene& scene, const std::string& where) {
  const MeasureKind& kind = kind_of(measure);
  if (uses(kind, "probe")) check_probe(measure, scene, measure.probe, where);
  if (uses(kind, "minus")) check_probe(measure, scene, measure.minus, where);
  if (uses(kind, "solid")) check_solids(measure, scene, where);
  if (kind.source == MeasureSource::stats && uses(kind, "column"))
    demand(where, "column of stats.csv", measure.column, columns_of(stats_header()));
  if (kind.source == MeasureSource::frames) check_frames(measure, scene, where);
  if (uses(kind, "data")) check_data(measure, scene, where);
  if (uses(kind, "from") && uses(kind, "to")) check_times(measure, scene, where);
  if (uses(kind, "unit")) check_divisor("unit", measure.unit, where);
  if (uses(kind, "reference") && error_in_words(measure).starts_with("relative"))
    check_divisor("reference", measure.reference, where);
}

void check_plot(const PlotSpec& plot, const std::string& where) {
  if (plot.data.empty()) return;
  check_file(plot.data, where, checked_series);
  check_divisor("value_unit", plot.value_unit, where);
}

}  // namespace seiche
