#pragma once
// State of the run loop that survives from session to session. Stored in the checkpoint beside the simulation's state,
// in entries whose names begin with "run.".
#include <cstdint>
#include <map>
#include <string>

#include "base/checkpoint_data.h"

namespace seiche {

struct RunState {
  std::int64_t step = 0;
  double time = 0;                                                                      // s
  int frame = -1;                                                                       // the last one written
  std::uint64_t stats_bytes = 0, solids_bytes = 0, probes_bytes = 0, joints_bytes = 0;  // sizes of the CSV files
  std::map<std::string, double> table_checksums;  // CRC-32C of those bytes, by file name
  std::map<std::string, double> probe_due;        // time of the next sample (s), by probe name
  std::map<std::string, double> phase_seconds;
  double wall_seconds = 0;
  double initial_volume = 0, liquid_volume = 0, expected_volume = 0, volume_corrected = 0;  // m^3
  double worst_residual = 0, worst_divergence = 0;
  double rejected_steps = 0, cells_liquid = 0;
  double unconverged_separations = 0;  // steps whose separating-wall iteration did not converge
  std::string scene_text;              // the normalised scene
};

void store(const RunState& state, CheckpointData& data);
// Throws Error(bad_checkpoint) naming a missing entry.
RunState restore_run_state(const CheckpointData& data);

}  // namespace seiche
