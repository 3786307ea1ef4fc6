#include "run/session.h"

#include <fmt/format.h>

#include <filesystem>
#include <new>

#include "base/agree.h"
#include "base/scene.h"
#include "base/thread_limit.h"
#include "coupling/state/operator_perturbation.h"
#include "fluid/rheology/rheology.h"
#include "run/fault.h"
#include "run/loop.h"
#include "run/memory.h"
#include "run/summary.h"
#include "run/threads.h"

namespace seiche {
namespace {

// Quotes the text if a shell would split or interpret it.
std::string shell_word(const std::string& text) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,:@%=";
  return text.find_first_not_of(plain) == std::string::npos ? text : "'" + text + "'";
}

std::string end_of(const RunSummary& summary, const RunPaths& paths) {
  // The message of a failure is printed last by the program, so it is not repeated here.
  const std::string ended = summary.ended.starts_with("failed") ? "failed" : summary.ended;
  std::string text = fmt::format("{} at t = {:g} s after {} steps and {} frames in {} ({} rank{}, {} thread{} each)\n",
                                 ended, summary.state.time, summary.state.step, summary.state.frame + 1,
                                 readable_seconds(summary.state.wall_seconds), summary.ranks,
                                 summary.ranks == 1 ? "" : "s", summary.threads, summary.threads == 1 ? "" : "s");
  text += fmt::format("liquid volume {:.6g}, drift {:+.3g} %; worst residual {:.2e}; peak memory {}, {:.0f} B a cell\n",
                      summary.state.liquid_volume, 100 * volume_drift(summary.state), summary.state.worst_residual,
                      readable_bytes(summary.peak_memory), bytes_per_cell(summary));
  if (const std::string shares = phase_shares(summary.state); !shares.empty())
    text += fmt::format("time: {}; {:.2e} cells/s\n", shares, cells_per_second(summary));
  text += "results in " + paths.folder.string();
  if (summary.code == ExitCode::stopped)
    text += fmt::format("\n`seiche resume {}` continues it", shell_word(paths.folder.string()));
  return text;
}

std::int64_t cells_of(const Scene& scene) {
  const auto& n = scene.domain.cells;
  return std::int64_t(n[0]) * n[1] * n[2];
}

RunSummary summarise(const Session& session, const Threads& threads, const RunState& state) {
  RunSummary summary;
  summary.state = state;
  summary.end = session.scene.time.end;
  summary.cells = cells_of(session.scene);
  summary.peak_memory = session.around.ranks.global_sum(peak_resident_bytes());
  summary.ranks = session.around.ranks.size();
  summary.threads = threads.count;
  summary.omp_num_threads = threads.omp_num_threads;
  return summary;
}

void write_summary(const Session& session, const RunSummary& summary) {
  agree_on_root(session.around.ranks, "writing the summary", [&] {
    write_file(session.paths.summary(), format_summary(summary));
    session.log.note(end_of(summary, session.paths));
    session.log.flush();
  });
}

// Failure to write the summary must not replace the run's own error.
void write_failed_summary(const Session& session, RunSummary summary, const Error& error) {
  summary.code = error.code();
  summary.ended = std::string("failed: ") + error.what();
  try {
    session.log.record(std::string("error: ") + error.what());
    write_summary(session, summary);
  } catch (const Error&) {
  }
}

void prepare_files(const Session& session) {
  agree_on_root(session.around.ranks, "preparing the run directory", [&] {
    make_folder(session.paths.frames());
    make_folder(session.paths.checkpoints());
    std::error_code ignored;
    std::filesystem::remove(session.paths.stop(), ignored);
    write_file(session.paths.scene(), write_scene(session.scene));
    session.log.open(session.paths.log());
  });
}

void end_hung_run(const Surroundings& around, double limit, const std::string& phase) {
  around.console.warning(
      fmt::format("rank {}: no progress for {:g} s in phase '{}'; the watchdog ends the run (exit 124). "
                  "`seiche resume` continues from the last checkpoint",
                  around.ranks.rank(), limit, phase));
  around.emergency.abort(int(ExitCode::hung));
}

ExitCode run_loop_to_end(const Session& session, const Threads& threads, Simulation& simulation, const RunState& start,
                         Watchdog& watchdog, const StopSignals& signals) {
  const FaultHook hook = make_fault_hook(parse_injection(session.options.inject), session.around.ranks.rank());
  RunLoop loop(simulation,
               {session.scene, session.around.ranks, session.around.emergency, session.paths, session.log, watchdog,
                signals, hook, session.options.walltime},
               start);
  try {
    const RunEnd end = loop.run();
    RunSummary summary = summarise(session, threads, loop.state());
    summary.code = end.code;
    summary.ended = end.how;
    watchdog.beat("summary");
    write_summary(session, summary);
    return end.code;
  } catch (const Error& error) {
    if (session.around.emergency.meet(int(error.code()), std::chrono::seconds(3))) {
      write_failed_summary(session, summarise(session, threads, loop.state()), error);
    }
    throw;
  }
}

}  // namespace

std::unique_ptr<RunDirectory> open_directory(const std::filesystem::path& folder, ExistingOutput policy,
                                             const Communicator& ranks, const RunDirectory::Announce& announce) {
  std::unique_ptr<RunDirectory> directory;
  agree_on_root(ranks, "opening the run directory",
                [&] { directory = std::make_unique<RunDirectory>(folder, policy, announce); });
  return directory;
}

bool stopped_early(const Communicator& ranks, RunLog& log) {
  const int number = noted_signal();
  if (!ranks.any(number != 0)) return false;
  std::string name;
  for (const std::string& got : ranks.all_gather(number != 0 ? signal_name(number) : ""))
    if (name.empty()) name = got;
  log.warn(fmt::format("stopped: {} before the first step; there is nothing to resume", name));
  return true;
}

ExitCode run_session(const Session& session, const Restore& restore) {
  const Surroundings& around = session.around;
  const StopSignals signals;
  const Threads threads = choose_threads(session.options.threads, around.ranks, session.log);
  const ThreadLimit limit(threads.count);
  Watchdog watchdog(std::chrono::duration<double>(session.options.watchdog),
                    [&](const std::string& phase) { end_hung_run(around, session.options.watchdog, phase); });
  try {
    if (stopped_early(around.ranks, session.log)) return ExitCode::stopped;
    watchdog.beat("setting up");
    Scene scene = session.scene;
    if (session.volume && scene.liquid.volume == VolumeKeeping::automatic) scene.liquid.volume = *session.volume;
    const std::unique_ptr<Simulation> simulation =
        make_simulation(scene, around.ranks, parse_perturbation(session.options.perturbation));
    prepare_files(session);
    watchdog.beat("restoring");
    const RunState start = restore ? restore(*simulation) : RunState{};
    if (const std::string text = describe_rheology(session.scene.liquid.rheology); !text.empty())
      session.log.note(text);
    for (const std::string& text : restore ? simulation->start_account().others : simulation->describe_start())
      session.log.note(text);
    for (const std::string& text : simulation->take_warnings()) session.log.warn(text);
    return run_loop_to_end(session, threads, *simulation, start, watchdog, signals);
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::machine,
                fmt::format("rank {}: out of memory while in phase '{}'", around.ranks.rank(), watchdog.phase()));
  }
}

}  // namespace seiche
