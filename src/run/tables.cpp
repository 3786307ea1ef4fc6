#include "run/tables.h"

#include <fmt/format.h>

#include <cmath>

#include "base/agree.h"
#include "base/error.h"
#include "base/scene.h"
#include "files/csv.h"

namespace seiche {
namespace {

const std::string stats_name = "stats.csv", solids_name = "solids.csv", probes_name = "probes.csv",
                  joints_name = "joints.csv";

TableMark mark_of(const RunState& state, const std::string& name, std::uint64_t bytes) {
  const auto sum = state.table_checksums.find(name);
  if (sum == state.table_checksums.end()) return {bytes, std::nullopt};
  return {bytes, std::uint32_t(sum->second)};
}

void set_mark(const TableMark& mark, const std::string& name, std::uint64_t& bytes, RunState& state) {
  bytes = mark.bytes;
  if (mark.checksum) state.table_checksums[name] = *mark.checksum;
}

// Damage of one table, or "". `bytes` of a damaged one shrinks to its complete lines.
std::string verify_table(const std::filesystem::path& path, const std::string& name, RunState& state,
                         std::uint64_t& bytes) {
  const std::string fault = fault_of_table(path, mark_of(state, name, bytes));
  if (!fault.empty()) {
    bytes = whole_lines(path, bytes);
    state.table_checksums.erase(name);
  }
  return fault;
}

void check_finite(const std::string& culprit, const std::string& owner, const StepStats& stats) {
  if (culprit.empty()) return;
  throw Error(ExitCode::cannot_continue,
              fmt::format("step {} at t = {:g} s: {} of {} is not a number; nothing of that step was "
                          "written",
                          stats.step, stats.time, culprit, owner));
}

// A sample is due at the first step end at or after its time, with a tolerance for rounding.
bool is_due(double due, double time, double every) {
  return time >= due - 1e-9 * every;
}

}  // namespace

std::vector<std::string> verify_tables(const RunPaths& paths, EditPolicy policy, RunState& state) {
  std::vector<std::string> faults;
  if (state.frame < 0) return faults;  // they start anew
  for (const std::string& fault :
       {verify_table(paths.stats(), stats_name, state, state.stats_bytes),
        verify_table(paths.solids(), solids_name, state, state.solids_bytes),
        verify_table(paths.probes(), probes_name, state, state.probes_bytes),
        state.joints_bytes > 0 ? verify_table(paths.joints(), joints_name, state, state.joints_bytes) : std::string()})
    if (!fault.empty()) faults.push_back(fault);
  if (policy == EditPolicy::force || faults.empty()) return faults;
  throw Error(ExitCode::bad_checkpoint,
              fmt::format("{}; restore the table, or give --force to continue with the rows that are there",
                          fmt::join(faults, "; ")));
}

RunTables::RunTables(const Scene& scene, const RunPaths& paths, const Communicator& ranks, RunState& state)
    : scene_(scene), ranks_(ranks) {
  agree_on_root(ranks, "opening the tables", [&] {
    stats_ = std::make_unique<TableFile>(paths.stats(), state.stats_bytes, stats_header());
    solids_ = std::make_unique<TableFile>(paths.solids(), state.solids_bytes, solids_header());
    probes_ = std::make_unique<TableFile>(paths.probes(), state.probes_bytes, probes_header());
    if (!scene.joints.empty())
      joints_ = std::make_unique<TableFile>(paths.joints(), state.joints_bytes, joints_header());
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
                           const std::vector<JointReport>& joints, const std::vector<ProbeSample>& samples) {
  stats_->append(stats_row(stats));
  for (const SolidState& solid : solids) solids_->append(solids_row(stats.time, solid));
  for (const ProbeSample& sample : samples) probes_->append(probes_row(stats.time, sample));
  for (const JointReport& joint : joints) joints_->append(joints_row(stats.time, joint));
  if (joints_) joints_->flush();
  stats_->flush();
  solids_->flush();
  probes_->flush();
}

void RunTables::add(const StepStats& stats, const Simulation& simulation, RunState& state) {
  const std::vector<SolidState> solids = simulation.solids();
  const std::vector<JointReport> joints = simulation.joints();
  const std::vector<ProbeSample> samples = due_samples(stats.time, simulation, state);
  agree(ranks_, "writing the tables", [&] {
    check_finite(not_finite(stats), "the flow", stats);
    for (const SolidState& solid : solids) check_finite(not_finite(solid), "solid '" + solid.name + "'", stats);
    for (const JointReport& joint : joints) check_finite(not_finite(joint), "joint '" + joint.name + "'", stats);
    for (const ProbeSample& sample : samples) check_finite(not_finite(sample), "probe '" + sample.name + "'", stats);
    if (!ranks_.is_root()) return;
    write_rows(stats, solids, joints, samples);
    set_mark(stats_->mark(), stats_name, state.stats_bytes, state);
    set_mark(solids_->mark(), solids_name, state.solids_bytes, state);
    set_mark(probes_->mark(), probes_name, state.probes_bytes, state);
    if (joints_) set_mark(joints_->mark(), joints_name, state.joints_bytes, state);
  });
}

void RunTables::sync() {
  agree_on_root(ranks_, "writing the tables", [&] {
    stats_->sync();
    solids_->sync();
    probes_->sync();
    if (joints_) joints_->sync();
  });
}

}  // namespace seiche
