#pragma once
// One session of a run: set-up around the run loop, and the summary at its end.
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/fluid_spec.h"
#include "coupling/state/simulation.h"
#include "files/run_directory.h"
#include "run/command.h"
#include "run/state.h"

namespace seiche {

struct Session {
  const Scene& scene;
  const Surroundings& around;
  const SessionOptions& options;
  RunLog& log;
  RunPaths paths;
  std::optional<VolumeKeeping> volume = {};  // as the run that goes on has kept it, in place of "auto"
};

// Restores the simulation's state and returns that of the run loop.
using Restore = std::function<RunState(Simulation&)>;

// Locks the run directory on rank 0; null elsewhere. `announce` is told on rank 0 what is removed. Collective.
std::unique_ptr<RunDirectory> open_directory(const std::filesystem::path& folder, ExistingOutput policy,
                                             const Communicator& ranks, const RunDirectory::Announce& announce = {});

// True if a rank received a stop signal since the program began; the log then says so. Collective.
bool stopped_early(const Communicator& ranks, RunLog& log);

// Creates the simulation, restores it if `restore` is given, writes scene.toml, runs the loop and writes summary.json.
// Rethrows the loop's errors after writing the summary. Collective.
ExitCode run_session(const Session& session, const Restore& restore);

}  // namespace seiche
