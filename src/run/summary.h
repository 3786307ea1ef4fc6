#pragma once
// summary.json: the end of a run and its cost.
#include <string>

#include "base/error.h"
#include "run/state.h"

namespace seiche {

struct RunSummary {
  ExitCode code = ExitCode::done;
  std::string ended;  // "finished", "stopped: SIGUSR1", "failed: <message>"
  RunState state;
  double end = 0;               // requested end time, s
  std::int64_t cells = 0;       // of the domain
  double peak_memory = 0;       // bytes, over all ranks
  int ranks = 1, threads = 1;   // threads a rank
  std::string omp_num_threads;  // "" where unset
};

// Cells of the domain times steps over wall seconds; peak memory over cells of the domain. 0 where nothing ran.
double cells_per_second(const RunSummary& summary);
double bytes_per_cell(const RunSummary& summary);

// "solve 61 %, surface 20 %": phases by their share of the wall time, the largest first, from 0.5 % on.
std::string phase_shares(const RunState& state);

// Volume drift relative to the volume expected from sources, inflow and outflow; zero for a run without liquid.
double volume_drift(const RunState& state);

// Warning for a drift beyond both 5 % and three cells, else "". The volume of tiny scenes is off by up to three cells
// as their surface moves. `cell` is the volume of a cell.
std::string volume_warning(const RunState& state, double cell);

std::string format_summary(const RunSummary& summary);

}  // namespace seiche
