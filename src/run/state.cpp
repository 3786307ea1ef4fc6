#include "run/state.h"

#include <fmt/format.h>

#include "base/error.h"

namespace seiche {
namespace {

// Missing in older checkpoints: then zero.
constexpr const char *unconverged_separations = "run.unsettled_partings", *joints_bytes = "run.joints_bytes";
const std::string probe_prefix = "run.probe_due.", phase_prefix = "run.phase.", checksum_prefix = "run.table_checksum.";

// One list for both directions: f(name, number) for every plain number of the state.
template <class State, class F>
void for_each_number(State& s, F&& f) {
  f("run.step", s.step);
  f("run.time", s.time);
  f("run.frame", s.frame);
  f("run.stats_bytes", s.stats_bytes);
  f("run.solids_bytes", s.solids_bytes);
  f("run.probes_bytes", s.probes_bytes);
  f(joints_bytes, s.joints_bytes);
  f("run.wall_seconds", s.wall_seconds);
  f("run.initial_volume", s.initial_volume);
  f("run.liquid_volume", s.liquid_volume);
  f("run.expected_volume", s.expected_volume);
  f("run.volume_corrected", s.volume_corrected);
  f("run.worst_residual", s.worst_residual);
  f("run.worst_divergence", s.worst_divergence);
  f("run.rejected_steps", s.rejected_steps);
  f("run.cells_liquid", s.cells_liquid);
  f(unconverged_separations, s.unconverged_separations);
}

std::map<std::string, double> with_prefix(const std::map<std::string, double>& all, const std::string& prefix) {
  std::map<std::string, double> found;
  for (auto entry = all.lower_bound(prefix); entry != all.end() && entry->first.starts_with(prefix); ++entry) {
    found[entry->first.substr(prefix.size())] = entry->second;
  }
  return found;
}

}  // namespace

void store(const RunState& state, CheckpointData& data) {
  for_each_number(state, [&](const char* name, auto value) { data.scalars[name] = double(value); });
  for (const auto& [name, due] : state.probe_due) data.scalars[probe_prefix + name] = due;
  for (const auto& [name, sum] : state.table_checksums) data.scalars[checksum_prefix + name] = sum;
  for (const auto& [name, seconds] : state.phase_seconds) data.scalars[phase_prefix + name] = seconds;
  data.texts["run.scene"] = state.scene_text;
}

RunState restore_run_state(const CheckpointData& data) {
  RunState state;
  for_each_number(state, [&](const char* name, auto& value) {
    const auto entry = data.scalars.find(name);
    if (entry == data.scalars.end() &&
        (name == std::string(unconverged_separations) || name == std::string(joints_bytes)))
      return;
    if (entry == data.scalars.end()) {
      throw Error(ExitCode::bad_checkpoint, fmt::format("the checkpoint lacks the entry {}", name));
    }
    value = static_cast<std::remove_reference_t<decltype(value)>>(entry->second);
  });
  state.probe_due = with_prefix(data.scalars, probe_prefix);
  state.table_checksums = with_prefix(data.scalars, checksum_prefix);
  state.phase_seconds = with_prefix(data.scalars, phase_prefix);
  const auto text = data.texts.find("run.scene");
  if (text != data.texts.end()) state.scene_text = text->second;
  return state;
}

}  // namespace seiche
