#pragma once
// summary.json: how a run ended and what it took.
#include <string>

#include "base/error.h"
#include "run/state.h"

namespace seiche {

struct RunSummary {
  ExitCode code = ExitCode::done;
  std::string ended;  // "finished", "stopped: SIGUSR1", "failed: <message>"
  RunState state;
  double end = 0;               // s, as asked for
  std::int64_t cells = 0;       // of the domain
  double peak_memory = 0;       // bytes, over all ranks
  int ranks = 1, threads = 1;   // threads a rank
  std::string omp_num_threads;  // "" where unset
};

// Volume drift relative to what sources and in- and outflow make expected; zero for a run without liquid.
double volume_drift(const RunState& state);

// The warning of a drift beyond a twentieth and beyond three cells, else "". Tiny scenes are off by three cells as
// their surface passes. `cell` is a cell's volume.
std::string volume_warning(const RunState& state, double cell);

std::string format_summary(const RunSummary& summary);

}  // namespace seiche
