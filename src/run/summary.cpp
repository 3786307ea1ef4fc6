#include "run/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/version.h"
#include "files/json.h"

namespace seiche {
namespace {

// JSON has no infinities.
std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

std::string phases(const RunState& state) {
  std::string text;
  for (const auto& [name, seconds] : state.phase_seconds) {
    text += fmt::format("{}\n    {}: {}", text.empty() ? "" : ",", json_string(name), json_number(seconds));
  }
  return "{" + text + "\n  }";
}

}  // namespace

double volume_drift(const RunState& state) {
  const double scale = std::max(std::abs(state.expected_volume), std::abs(state.initial_volume));
  return scale > 0 ? (state.liquid_volume - state.expected_volume) / scale : 0;
}

std::string volume_warning(const RunState& state, double cell) {
  constexpr double drift_told = 0.05, cells_told = 3;
  const double amiss = std::abs(state.liquid_volume - state.expected_volume);
  if (std::abs(volume_drift(state)) <= drift_told || amiss <= cells_told * cell) return {};
  return fmt::format(
      "step {}: the liquid's volume is {:.6g} where {:.6g} is expected of what was there, sources, inflow and outflow, "
      "{:+.3g} %: shorter steps (time.cfl, time.max_step) or smaller cells keep it (told once a session)",
      state.step, state.liquid_volume, state.expected_volume, 100 * volume_drift(state));
}

std::string format_summary(const RunSummary& s) {
  const std::pair<const char*, std::string> rows[] = {
      {"ended", json_string(s.ended)},
      {"exit_code", std::to_string(int(s.code))},
      {"version", json_string(version())},
      {"ranks", std::to_string(s.ranks)},
      {"threads", std::to_string(s.threads)},
      {"omp_num_threads", s.omp_num_threads.empty() ? "null" : json_string(s.omp_num_threads)},
      {"steps", std::to_string(s.state.step)},
      {"rejected_steps", json_number(s.state.rejected_steps)},
      {"unsettled_partings", json_number(s.state.unconverged_separations)},
      {"frames", std::to_string(s.state.frame + 1)},
      {"time", json_number(s.state.time)},
      {"end", json_number(s.end)},
      {"cells", std::to_string(s.cells)},
      {"cells_liquid", json_number(s.state.cells_liquid)},
      {"wall_seconds", json_number(s.state.wall_seconds)},
      {"wall_seconds_by_phase", phases(s.state)},
      {"peak_memory_bytes", json_number(s.peak_memory)},
      {"initial_volume", json_number(s.state.initial_volume)},
      {"liquid_volume", json_number(s.state.liquid_volume)},
      {"expected_volume", json_number(s.state.expected_volume)},
      {"volume_drift", json_number(volume_drift(s.state))},
      {"volume_corrected", json_number(s.state.volume_corrected)},
      {"worst_residual", json_number(s.state.worst_residual)},
      {"worst_divergence", json_number(s.state.worst_divergence)}};
  std::string text;
  for (const auto& [name, value] : rows) {
    text += fmt::format("{}\n  {}: {}", text.empty() ? "" : ",", json_string(name), value);
  }
  return "{" + text + "\n}\n";
}

}  // namespace seiche
