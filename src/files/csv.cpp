#include "files/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>
#include <variant>
#include <vector>

namespace seiche {

// One table for both header and rows. The documented format fixes the columns up to wall_seconds and their order.
std::vector<TableColumn> columns_of(const StepStats& s) {
  return {{"step", s.step},
          {"time", s.time},
          {"dt", s.dt},
          {"liquid_volume", s.liquid_volume},
          {"kinetic_energy", s.kinetic_energy},
          {"potential_energy", s.potential_energy},
          {"elastic_energy", s.elastic_energy},
          {"momentum_x", s.momentum[0]},
          {"momentum_y", s.momentum[1]},
          {"momentum_z", s.momentum[2]},
          {"max_speed", s.max_speed},
          {"max_divergence", s.max_divergence},
          {"solver_iterations", std::int64_t(s.solver_iterations)},
          {"solver_residual", s.solver_residual},
          {"newton_iterations", std::int64_t(s.newton_iterations)},
          {"contacts", std::int64_t(s.contacts)},
          {"cells_liquid", s.cells_liquid},
          {"wall_seconds", s.wall_seconds},
          {"volume_corrected", s.volume_corrected},
          {"rejected", std::int64_t(s.rejected)},
          {"viscous_dissipation", s.viscous_dissipation},
          {"rheology_iterations", std::int64_t(s.rheology_iterations)},
          {"gas_volume", s.gas_volume},
          {"bubbles", s.bubbles},
          {"air_lost", s.air_lost},
          {"work_gravity", s.work.gravity},
          {"work_tension", s.work.tension},
          {"work_sides", s.work.sides},
          {"work_solids", s.work.solids},
          {"lost_viscous", s.work.lost_viscous},
          {"lost_numerical", s.work.lost_numerical},
          {"volume_spilled", s.volume_spilled},
          {"volume_drifting", s.volume_drifting},
          {"joint_gap", s.joint_gap},
          {"joint_turns", std::int64_t(s.joint_turns)},
          {"drops", s.drops},
          {"volume_drops", s.volume_drops},
          {"volume_left_out", s.volume_left_out}};
}

std::vector<TableColumn> columns_of(const JointReport& j) {
  return {{"q", j.q},
          {"qdot", j.rate},
          {"fx", j.force[0]},
          {"fy", j.force[1]},
          {"fz", j.force[2]},
          {"tx", j.torque[0]},
          {"ty", j.torque[1]},
          {"tz", j.torque[2]},
          {"power", j.power},
          {"gap", j.gap},
          {"broken", std::int64_t(j.broken)}};
}

namespace {

std::vector<TableColumn> columns_of(const SolidState& s) {
  return {{"x", s.position[0]},
          {"y", s.position[1]},
          {"z", s.position[2]},
          {"qw", s.orientation[0]},
          {"qx", s.orientation[1]},
          {"qy", s.orientation[2]},
          {"qz", s.orientation[3]},
          {"vx", s.velocity[0]},
          {"vy", s.velocity[1]},
          {"vz", s.velocity[2]},
          {"wx", s.angular_velocity[0]},
          {"wy", s.angular_velocity[1]},
          {"wz", s.angular_velocity[2]},
          {"fx", s.force[0]},
          {"fy", s.force[1]},
          {"fz", s.force[2]},
          {"tx", s.torque[0]},
          {"ty", s.torque[1]},
          {"tz", s.torque[2]},
          {"pin_fx", s.pin_force[0]},
          {"pin_fy", s.pin_force[1]},
          {"pin_fz", s.pin_force[2]},
          {"pin_tx", s.pin_torque[0]},
          {"pin_ty", s.pin_torque[1]},
          {"pin_tz", s.pin_torque[2]}};
}

std::string text_of(const std::variant<double, std::int64_t>& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{:.17g}", std::get<double>(value));
}

// Quotes names with commas, quotes or line ends (RFC 4180).
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  std::string result = "\"";
  for (const char c : name) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

std::string joined_names(const std::vector<TableColumn>& row) {
  std::vector<std::string> names;
  for (const TableColumn& c : row) names.emplace_back(c.name);
  return fmt::format("{}", fmt::join(names, ","));
}

std::string joined_values(const std::vector<TableColumn>& row) {
  std::vector<std::string> values;
  for (const TableColumn& c : row) values.push_back(text_of(c.value));
  return fmt::format("{}", fmt::join(values, ","));
}

std::string first_not_finite(const std::vector<TableColumn>& row) {
  for (const TableColumn& c : row) {
    const auto* number = std::get_if<double>(&c.value);
    if (number != nullptr && !std::isfinite(*number)) return c.name;
  }
  return {};
}

}  // namespace

std::string stats_header() {
  return joined_names(columns_of(StepStats{})) + "\n";
}
std::string stats_row(const StepStats& stats) {
  return joined_values(columns_of(stats)) + "\n";
}
std::string solids_header() {
  return "time,name," + joined_names(columns_of(SolidState{})) + "\n";
}

std::string solids_row(double time, const SolidState& solid) {
  return fmt::format("{:.17g},{},{}\n", time, quoted(solid.name), joined_values(columns_of(solid)));
}

std::string joints_header() {
  return "time,name," + joined_names(columns_of(JointReport{})) + "\n";
}

std::string joints_row(double time, const JointReport& joint) {
  return fmt::format("{:.17g},{},{}\n", time, quoted(joint.name), joined_values(columns_of(joint)));
}

std::string probes_header() {
  return "time,name,value,x,y,z\n";
}

std::string probes_row(double time, const ProbeSample& sample) {
  const std::string start = fmt::format("{:.17g},{},", time, quoted(sample.name));
  if (!sample.defined) return start + ",,,\n";
  if (!sample.is_vector) return start + fmt::format("{:.17g},,,\n", sample.value);
  return start + fmt::format(",{:.17g},{:.17g},{:.17g}\n", sample.vector[0], sample.vector[1], sample.vector[2]);
}

std::string not_finite(const StepStats& stats) {
  return first_not_finite(columns_of(stats));
}
std::string not_finite(const SolidState& solid) {
  return first_not_finite(columns_of(solid));
}

std::string not_finite(const JointReport& joint) {
  return first_not_finite(columns_of(joint));
}

std::string not_finite(const ProbeSample& sample) {
  if (!sample.defined) return {};
  if (!sample.is_vector) return std::isfinite(sample.value) ? "" : "the value";
  return sample.vector.allFinite() ? "" : "the vector";
}

}  // namespace seiche
