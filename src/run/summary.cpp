#include "run/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/version.h"
#include "files/json.h"

namespace seiche {
namespace {

JsonMembers phases(const RunState& state) {
  JsonMembers members;
  for (const auto& [name, seconds] : state.phase_seconds) members.emplace_back(name, seconds);
  return members;
}

}  // namespace

double cells_per_second(const RunSummary& s) {
  return s.state.wall_seconds > 0 ? double(s.cells) * s.state.step / s.state.wall_seconds : 0;
}

double bytes_per_cell(const RunSummary& s) {
  return s.cells > 0 ? s.peak_memory / double(s.cells) : 0;
}

std::string phase_shares(const RunState& state) {
  std::vector<std::pair<double, std::string>> by_share;
  for (const auto& [name, seconds] : state.phase_seconds) by_share.emplace_back(-seconds, name);
  std::sort(by_share.begin(), by_share.end());
  std::string text;
  for (const auto& [seconds, name] : by_share)
    if (const double percent = -100 * seconds / std::max(state.wall_seconds, 1e-9); percent >= 0.5)
      text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ", name, percent);
  return text;
}

double volume_drift(const RunState& state) {
  const double scale = std::max(std::abs(state.expected_volume), std::abs(state.initial_volume));
  return scale > 0 ? (state.liquid_volume - state.expected_volume) / scale : 0;
}

std::string volume_warning(const RunState& state, double cell) {
  constexpr double drift_told = 0.05, cells_told = 3;
  const double amiss = std::abs(state.liquid_volume - state.expected_volume);
  if (std::abs(volume_drift(state)) <= drift_told || amiss <= cells_told * cell) return {};
  return fmt::format(
      "step {}: the liquid's volume is {:.6g}, expected {:.6g} from start, sources, inflow and outflow ({:+.3g} %); "
      "use shorter steps (time.cfl, time.max_step) or smaller cells (reported once per session)",
      state.step, state.liquid_volume, state.expected_volume, 100 * volume_drift(state));
}

std::string format_summary(const RunSummary& s) {
  return format_json(JsonMembers{{"ended", s.ended},
                                 {"exit_code", int(s.code)},
                                 {"version", version()},
                                 {"ranks", s.ranks},
                                 {"threads", s.threads},
                                 {"omp_num_threads", s.omp_num_threads.empty() ? JsonValue() : s.omp_num_threads},
                                 {"steps", s.state.step},
                                 {"rejected_steps", s.state.rejected_steps},
                                 {"unconverged_separations", s.state.unconverged_separations},
                                 {"frames", s.state.frame + 1},
                                 {"time", s.state.time},
                                 {"end", s.end},
                                 {"cells", s.cells},
                                 {"cells_liquid", s.state.cells_liquid},
                                 {"wall_seconds", s.state.wall_seconds},
                                 {"wall_seconds_by_phase", phases(s.state)},
                                 {"cells_per_second", cells_per_second(s)},
                                 {"peak_memory_bytes", s.peak_memory},
                                 {"bytes_per_cell", bytes_per_cell(s)},
                                 {"initial_volume", s.state.initial_volume},
                                 {"liquid_volume", s.state.liquid_volume},
                                 {"expected_volume", s.state.expected_volume},
                                 {"volume_drift", volume_drift(s.state)},
                                 {"volume_corrected", s.state.volume_corrected},
                                 {"worst_residual", s.state.worst_residual},
                                 {"worst_divergence", s.state.worst_divergence}});
}

}  // namespace seiche
