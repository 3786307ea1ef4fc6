#pragma once
// One session of a run: what is set up around the run loop, and the account that is given at its end.
#include <functional>
#include <memory>
#include <string>

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
};

// Puts the simulation's state back and returns the run loop's.
using Restore = std::function<RunState(Simulation&)>;

// Locks the run directory on rank 0; null elsewhere. Collective.
std::unique_ptr<RunDirectory> open_directory(const std::filesystem::path& folder, ExistingOutput policy,
                                             const Communicator& ranks);

// Whether a rank got a signal to stop since the program began; the log then says so. Collective.
bool stopped_early(const Communicator& ranks, RunLog& log);

// Builds the simulation, restores it where `restore` is given, writes scene.toml, runs the loop and writes
// summary.json. Collective; throws what the loop throws, after the summary is written.
ExitCode run_session(const Session& session, const Restore& restore);

}  // namespace seiche
