#include "io/run_tables.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "io/csv.h"
#include "io/run_agree.h"

namespace seiche {
namespace {

std::unique_ptr<AppendFile> open_table(const std::filesystem::path& path, std::uint64_t keep,
                                       const std::string& header) {
  auto file = std::make_unique<AppendFile>(path, keep);
  if (file->size() == 0) file->append(header);
  file->flush();
  return file;
}

void check_finite(const std::string& culprit, const std::string& owner, const StepStats& stats) {
  if (culprit.empty()) return;
  throw Error(ExitCode::cannot_continue,
              fmt::format("step {} at t = {:g} s: {} of {} is not a number; nothing of that step was "
                          "written",
                          stats.step, stats.time, culprit, owner));
}

// A sample is due at the first step end at or after its time; times that rounding splits from it still count.
bool is_due(double due, double time, double every) {
  return time >= due - 1e-9 * every;
}

}  // namespace

RunTables::RunTables(const Scene& scene, const RunPaths& paths, const Communicator& ranks, RunState& state)
    : scene_(scene), ranks_(ranks) {
  agree_on_root(ranks, "opening the tables", [&] {
    stats_ = open_table(paths.stats(), state.stats_bytes, stats_header());
    solids_ = open_table(paths.solids(), state.solids_bytes, solids_header());
    probes_ = open_table(paths.probes(), state.probes_bytes, probes_header());
  });
}

std::vector<ProbeSample> RunTables::due_samples(double time, const Simulation& simulation, RunState& state) const {
  std::vector<ProbeSample> samples;
  for (std::size_t n = 0; n < scene_.probes.size(); ++n) {
    const ProbeSpec& probe = scene_.probes[n];
    if (probe.every) {
      double& due = state.probe_due[probe.name];
      if (!is_due(due, time, *probe.every)) continue;
      due = (std::floor(time / *probe.every + 1e-9) + 1) * *probe.every;
    }
    samples.push_back(simulation.probe(n));
  }
  return samples;
}

void RunTables::write_rows(const StepStats& stats, const std::vector<SolidState>& solids,
                           const std::vector<ProbeSample>& samples) {
  stats_->append(stats_row(stats));
  for (const SolidState& solid : solids) solids_->append(solids_row(stats.time, solid));
  for (const ProbeSample& sample : samples) probes_->append(probes_row(stats.time, sample));
  stats_->flush();
  solids_->flush();
  probes_->flush();
}

void RunTables::add(const StepStats& stats, const Simulation& simulation, RunState& state) {
  const std::vector<SolidState> solids = simulation.solids();
  const std::vector<ProbeSample> samples = due_samples(stats.time, simulation, state);
  agree(ranks_, "writing the tables", [&] {
    check_finite(not_finite(stats), "the flow", stats);
    for (const SolidState& solid : solids) check_finite(not_finite(solid), "solid '" + solid.name + "'", stats);
    for (const ProbeSample& sample : samples) check_finite(not_finite(sample), "probe '" + sample.name + "'", stats);
    if (!ranks_.is_root()) return;
    write_rows(stats, solids, samples);
    state.stats_bytes = stats_->size();
    state.solids_bytes = solids_->size();
    state.probes_bytes = probes_->size();
  });
}

void RunTables::sync() {
  agree_on_root(ranks_, "writing the tables", [&] {
    stats_->sync();
    solids_->sync();
    probes_->sync();
  });
}

}  // namespace seiche
