#pragma once
// The tables of a run: stats.csv, solids.csv and probes.csv, and joints.csv if the scene has joints.
#include <memory>
#include <vector>

#include "coupling/state/simulation.h"
#include "files/run_directory.h"
#include "files/table_file.h"
#include "run/scene.h"
#include "run/state.h"

namespace seiche {

struct Scene;

// Compares the tables with their checkpoint. Damage throws Error(bad_checkpoint). With `force` it is returned as
// warnings, and `state` is changed to continue after the remaining complete lines. Not collective.
std::vector<std::string> verify_tables(const RunPaths& paths, EditPolicy policy, RunState& state);

class RunTables {
 public:
  // Opens the tables on rank 0, truncated to the sizes in `state`; new ones get their headers. Collective.
  RunTables(const Scene& scene, const RunPaths& paths, const Communicator& ranks, RunState& state);

  // Appends the rows of one step and of the due probes. Collective. Throws on all ranks: Error(output_failed), or
  // Error(cannot_continue) naming the number that is not finite; then no row is written.
  void add(const StepStats& stats, const Simulation& simulation, RunState& state);
  void sync();  // flushes to the disk; collective

 private:
  std::vector<ProbeSample> due_samples(double time, const Simulation& simulation, RunState& state) const;
  void write_rows(const StepStats& stats, const std::vector<SolidState>& solids, const std::vector<JointReport>& joints,
                  const std::vector<ProbeSample>& samples);

  const Scene& scene_;
  const Communicator& ranks_;
  std::unique_ptr<TableFile> stats_, solids_, probes_, joints_;  // rank 0; null: the scene has none
};

}  // namespace seiche
