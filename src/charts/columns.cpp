#include "charts/columns.h"

#include <algorithm>
#include <string_view>

namespace seiche::charts {
namespace {

struct UnitRow {
  std::string_view table, columns, unit;  // columns with a space before and after each
};

constexpr UnitRow unit_rows[] = {
    {"stats", " time dt wall_seconds ", "s"},
    {"stats",
     " liquid_volume volume_corrected gas_volume air_lost volume_spilled volume_drifting volume_drops volume_left_out ",
     "m³"},
    {"stats",
     " kinetic_energy potential_energy elastic_energy work_gravity work_tension work_sides work_solids lost_viscous "
     "lost_numerical ",
     "J"},
    {"stats", " momentum_x momentum_y momentum_z ", "N s"},
    {"stats", " max_speed ", "m/s"},
    {"stats", " max_divergence ", "s⁻¹"},
    {"stats", " viscous_dissipation ", "W"},
    {"stats", " joint_gap ", "m"},
    {"solids", " time ", "s"},
    {"solids", " x y z ", "m"},
    {"solids", " vx vy vz ", "m/s"},
    {"solids", " wx wy wz ", "rad/s"},
    {"solids", " fx fy fz pin_fx pin_fy pin_fz ", "N"},
    {"solids", " tx ty tz pin_tx pin_ty pin_tz ", "N m"},
    {"joints", " time ", "s"},
    {"joints", " q ", "rad or m"},
    {"joints", " qdot ", "rad/s or m/s"},
    {"joints", " fx fy fz ", "N"},
    {"joints", " tx ty tz ", "N m"},
    {"joints", " power ", "W"},
    {"joints", " gap ", "m"},
    {"probes", " time ", "s"},
    {"probes", " value ", "Pa, m, m³/s or m³"},
    {"probes", " x y z ", "m/s, m, N or N m"},
};

struct Group {
  const char* word;
  std::vector<std::string> columns;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> list{
      {"energy", {"kinetic_energy", "potential_energy", "elastic_energy"}},
      {"volume", {"liquid_volume"}},
      {"momentum", {"momentum_x", "momentum_y", "momentum_z"}},
      {"work", {"work_gravity", "work_tension", "work_sides", "work_solids", "lost_viscous", "lost_numerical"}},
      {"iterations", {"solver_iterations", "newton_iterations"}},
      {"speed", {"max_speed"}},
      {"position", {"x", "y", "z"}},
      {"velocity", {"vx", "vy", "vz"}},
      {"rotation", {"wx", "wy", "wz"}},
      {"force", {"fx", "fy", "fz"}},
      {"torque", {"tx", "ty", "tz"}},
  };
  return list;
}

std::vector<std::string> present(const Table& table, const std::vector<std::string>& columns) {
  std::vector<std::string> found;
  for (const std::string& column : columns)
    if (table.find(column) < table.columns.size()) found.push_back(column);
  return found;
}

}  // namespace

std::string unit_of(const std::string& table, const std::string& column) {
  for (const UnitRow& row : unit_rows)
    if (row.table == table && row.columns.find(" " + column + " ") != std::string_view::npos)
      return std::string(row.unit);
  return "";
}

std::string unit_in_2d(const std::string& unit) {
  if (unit == "m³") return "m²";
  if (unit == "N m") return "N";
  const bool per_depth = unit == "J" || unit == "N s" || unit == "W" || unit == "N";
  return per_depth ? unit + "/m" : unit;
}

const std::vector<std::string>& table_names() {
  static const std::vector<std::string> names{"stats", "solids", "probes", "joints"};
  return names;
}

std::vector<std::string> columns_meant(const Table& table, const std::string& word) {
  if (table.find(word) < table.columns.size()) return {word};
  for (const Group& group : groups())
    if (group.word == word) return present(table, group.columns);
  return {};
}

std::vector<std::string> groups_of(const Table& table) {
  std::vector<std::string> words;
  for (const Group& group : groups())
    if (!present(table, group.columns).empty()) words.emplace_back(group.word);
  return words;
}

}  // namespace seiche::charts
