#include "charts/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/scene.h"
#include "base/suggest.h"
#include "charts/columns.h"
#include "files/run_directory.h"
#include "scene/reader.h"

namespace seiche::charts {
namespace {

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& table) {
  const RunPaths paths{folder};
  if (table == "solids") return paths.solids();
  if (table == "probes") return paths.probes();
  return table == "joints" ? paths.joints() : paths.stats();
}

// A column of a table for one name, from the rows of that name.
Curve curve_of(const Table& table, const std::string& column, const std::string& name, const std::string& label) {
  Curve curve{label, {}, {}};
  const std::vector<double>&time = table.values[table.find("time")], &value = table.values[table.find(column)];
  for (std::size_t row = 0; row < time.size(); ++row) {
    if (!table.names.empty() && table.names[row] != name) continue;
    curve.time.push_back(time[row]);
    curve.value.push_back(value[row]);
  }
  return curve;
}

bool is_empty(const Curve& curve) {
  return std::none_of(curve.value.begin(), curve.value.end(), [](double value) { return std::isfinite(value); });
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string without_empty(std::initializer_list<std::string> words) {
  std::string text;
  for (const std::string& word : words)
    if (!word.empty()) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// Unit of a column in the panels of these runs, which the first one decides.
std::string unit_here(const std::vector<RunTables>& runs, const std::string& table, const std::string& column) {
  const std::string unit = unit_of(table, column);
  return runs.front().dimension == 2 ? unit_in_2d(unit) : unit;
}

std::string with_unit(const std::string& what, const std::string& unit) {
  const bool one = !unit.empty() && unit.find(" or ") == std::string::npos;
  return one ? fmt::format("{} ({})", what, unit) : what;
}

[[noreturn]] void refuse_column(std::vector<RunTables>& runs, const PlotOptions& options, const std::string& word) {
  std::string text = fmt::format("--columns: no table has '{}'", word);
  if (!options.table.empty()) text = fmt::format("--columns: {}.csv has no '{}'", options.table, word);
  std::vector<std::string> known;
  std::string lists;
  for (const std::string& name : table_names()) {
    if (!options.table.empty() && name != options.table) continue;
    const Table* table = runs.front().table(name);
    if (!table) continue;
    std::vector<std::string> words = table->columns;
    const std::vector<std::string> groups = groups_of(*table);
    lists += fmt::format("\n  {}.csv has {}", name, joined(words));
    if (!groups.empty()) lists += fmt::format(", and the groups {}", joined(groups));
    known.insert(known.end(), words.begin(), words.end());
    known.insert(known.end(), groups.begin(), groups.end());
  }
  const auto near = suggest(word, known);
  throw Error(ExitCode::bad_input, text + (near ? fmt::format("; did you mean '{}'?", *near) : "") + lists);
}

// The first table in which all words mean columns.
std::string find_table(std::vector<RunTables>& runs, const PlotOptions& options) {
  std::string missing = options.columns.front();
  for (const std::string& name : table_names()) {
    if (!options.table.empty() && name != options.table) continue;
    const Table* table = runs.front().table(name);
    if (!table) continue;
    const auto lacking = std::find_if(options.columns.begin(), options.columns.end(),
                                      [&](const std::string& word) { return columns_meant(*table, word).empty(); });
    if (lacking == options.columns.end()) return name;
    if (lacking != options.columns.begin() || !options.table.empty()) missing = *lacking;
  }
  refuse_column(runs, options, missing);
}

std::vector<std::string> chosen_names(const Table& table, const PlotOptions& options, const std::string& where) {
  const std::vector<std::string> all = table.entities();
  if (options.names.empty()) return all;
  for (const std::string& name : options.names) {
    if (std::find(all.begin(), all.end(), name) != all.end()) continue;
    const auto near = suggest(name, all);
    throw Error(ExitCode::bad_input, fmt::format("--names: {} has no '{}'{}; it has {}", where, name,
                                                 near ? fmt::format("; did you mean '{}'?", *near) : "",
                                                 table.names.empty() ? "no names; leave the option out" : joined(all)));
  }
  return options.names;
}

// Panels in order of their units' first appearance.
class PanelList {
 public:
  explicit PanelList(bool logarithmic) : logarithmic_(logarithmic) {}

  Panel& panel(const std::string& key, const std::string& title) {
    for (std::size_t n = 0; n < keys_.size(); ++n)
      if (keys_[n] == key) return panels_[n];
    keys_.push_back(key);
    panels_.push_back({title, {}, logarithmic_});
    return panels_.back();
  }
  std::vector<Panel> take() {
    std::erase_if(panels_, [](const Panel& panel) { return panel.curves.empty(); });
    return std::move(panels_);
  }

 private:
  bool logarithmic_;
  std::vector<std::string> keys_;
  std::vector<Panel> panels_;
};

// Title of a panel of several words of --columns: all of them, if they are few.
void retitle(Panel& panel, const std::string& word, const std::string& unit) {
  if (panel.title.empty()) {
    panel.title = with_unit(word, unit);
  } else if (panel.title.find(word) == std::string::npos && panel.title.size() + word.size() < 40) {
    panel.title = with_unit(panel.title.substr(0, panel.title.rfind(unit.empty() ? "" : " (")) + ", " + word, unit);
  }
}

double first_value(const Curve& curve) {
  for (const double value : curve.value)
    if (std::isfinite(value)) return value;
  return 0;
}

// Treatment of the row of the start, t = 0.
enum class Start { stays, is_zero, is_gap };

// Adds a column of stats.csv of each run.
void add_stats(std::vector<RunTables>& runs, Panel& panel, const std::string& column, const std::string& label,
               Start start) {
  for (RunTables& run : runs) {
    const Table* table = run.table("stats");
    if (!table || table->find(column) == table->columns.size()) continue;
    Curve curve = curve_of(*table, column, "", without_empty({label, run.label}));
    const double first = start == Start::is_zero ? first_value(curve) : 0;
    for (double& value : curve.value) value -= first;
    if (start == Start::is_gap && !curve.value.empty() && curve.time[0] == 0) curve.value[0] = NAN;
    const bool all_zero =
        std::all_of(curve.value.begin(), curve.value.end(), [](double v) { return !(std::abs(v) > 0); });
    if (!all_zero) panel.curves.push_back(std::move(curve));
  }
}

const char* unit_of_kind(const ProbeSpec& probe) {
  switch (probe.kind) {
    case ProbeKind::pressure:
      return "Pa";
    case ProbeKind::velocity:
      return "m/s";
    case ProbeKind::joint:
      return probe.quantity == JointQuantity::force    ? "N"
             : probe.quantity == JointQuantity::torque ? "N m"
             : probe.quantity == JointQuantity::power  ? "W"
                                                       : "rad or m";
    default:
      return "m";
  }
}

void add_probes(std::vector<RunTables>& runs, PanelList& list, const PlotOptions& options) {
  for (RunTables& run : runs) {
    const Table* table = run.table("probes");
    if (!table) continue;
    std::map<std::string, std::string>& units = run.probe_units;
    for (const std::string& name : chosen_names(*table, options, "probes.csv")) {
      for (const char* column : {"value", "x", "y", "z"}) {
        if (table->find(column) == table->columns.size()) continue;
        const std::string part = std::string_view(column) == "value" ? "" : column;
        Curve curve =
            curve_of(*table, column, name, without_empty({part.empty() ? name : name + "." + part, run.label}));
        const bool flat = part == "z" && first_value(curve) == 0;
        if (is_empty(curve) || flat) continue;
        const std::string unit = units.count(name) > 0 ? units[name] : unit_here(runs, "probes", column);
        list.panel("probes " + unit, with_unit("probes", unit)).curves.push_back(std::move(curve));
      }
    }
  }
}

}  // namespace

void RunTables::read_scene_of_run() {
  try {
    const Scene scene = read_scene(RunPaths{folder}.scene());
    dimension = scene.dimension;
    for (const ProbeSpec& probe : scene.probes) {
      const std::string unit = unit_of_kind(probe);
      probe_units[probe.name] = dimension == 2 ? unit_in_2d(unit) : unit;
    }
  } catch (const Error&) {  // units are then those of 3D, and of all kinds of probes
  }
}

const Table* RunTables::table(const std::string& name) {
  const auto known = tables.find(name);
  if (known != tables.end()) return &known->second;
  const std::filesystem::path file = file_of(folder, name);
  if (!std::filesystem::exists(file)) return nullptr;
  return &(tables[name] = read_table(file));
}

std::vector<Panel> panels_of_columns(std::vector<RunTables>& runs, const PlotOptions& options) {
  const std::string name = find_table(runs, options);
  PanelList list(options.logarithmic);
  for (const std::string& word : options.columns) {
    for (RunTables& run : runs) {
      const Table* table = run.table(name);
      if (!table || columns_meant(*table, word).empty())
        throw Error(ExitCode::bad_input,
                    fmt::format("--columns: {} has no '{}' in {}.csv", run.folder.string(), word, name));
      for (const std::string& column : columns_meant(*table, word)) {
        const std::string unit = unit_here(runs, name, column);
        Panel& panel = list.panel(unit.empty() ? column : unit, "");
        retitle(panel, word, unit);
        for (const std::string& who : chosen_names(*table, options, name + ".csv")) {
          Curve curve = curve_of(*table, column, who, without_empty({column, who, run.label}));
          if (!is_empty(curve)) panel.curves.push_back(std::move(curve));
        }
      }
    }
  }
  return list.take();
}

std::vector<Panel> usual_panels(std::vector<RunTables>& runs, const PlotOptions& options) {
  PanelList list(options.logarithmic);
  Panel& energy = list.panel("energy", with_unit("energy", unit_here(runs, "stats", "kinetic_energy")));
  add_stats(runs, energy, "kinetic_energy", "kinetic", Start::stays);
  add_stats(runs, energy, "potential_energy", "potential - start", Start::is_zero);
  add_stats(runs, energy, "elastic_energy", "elastic", Start::stays);
  Panel& volume = list.panel("volume", with_unit("volume", unit_here(runs, "stats", "liquid_volume")));
  add_stats(runs, volume, "liquid_volume", "liquid", Start::stays);
  add_stats(runs, volume, "gas_volume", "gas", Start::stays);
  add_stats(runs, list.panel("speed", "largest speed (m/s)"), "max_speed", "", Start::stays);
  add_stats(runs, list.panel("step", "step (s)"), "dt", "", Start::is_gap);
  Panel& iterations = list.panel("iterations", "iterations a step");
  add_stats(runs, iterations, "solver_iterations", "solver", Start::is_gap);
  add_stats(runs, iterations, "newton_iterations", "Newton", Start::is_gap);
  add_probes(runs, list, options);
  return list.take();
}

}  // namespace seiche::charts
