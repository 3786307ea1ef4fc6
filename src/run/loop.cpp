#include "run/loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/agree.h"
#include "base/scene.h"
#include "files/checkpoint.h"
#include "run/scene.h"
#include "run/summary.h"
#include "scene/writer.h"

namespace seiche {
namespace {

constexpr auto patience = std::chrono::seconds(3);  // wait for other ranks to report the same error

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

ProgressScale progress_scale(const Scene& scene, double start) {
  const auto& n = scene.domain.cells;
  return {std::int64_t(n[0]) * n[1] * n[2], last_frame(scene.time), start, scene.time.end};
}

// A run that failed before its first frame starts its tables anew.
RunState without_rows_before_first_frame(RunState state) {
  if (state.frame < 0) state.stats_bytes = state.solids_bytes = state.probes_bytes = state.joints_bytes = 0;
  return state;
}

}  // namespace

int last_frame(const TimeSpec& time) {
  if (time.end < 0) return -1;
  return int(std::min(time.end * time.frame_rate * (1 + 1e-12) + 1e-9, 1e9));
}

RunLoop::RunLoop(Simulation& simulation, const RunContext& context, RunState state)
    : simulation_(simulation),
      context_(context),
      state_(without_rows_before_first_frame(std::move(state))),
      tables_(context.scene, context.paths, context.ranks, state_),
      frames_(context.scene, context.paths, context.ranks),
      progress_(context.log, progress_scale(context.scene, state_.time)),
      last_(simulation.stats()),
      earlier_seconds_(state_.wall_seconds),
      earlier_phases_(state_.phase_seconds) {
  state_.scene_text = write_scene(context_.scene);
  simulation_.set_fault_hook([this](const std::string& phase) { return visit(phase); });
}

RunLoop::~RunLoop() {
  simulation_.set_fault_hook([](const std::string&) { return PhaseFault::none; });
}

PhaseFault RunLoop::visit(const std::string& phase) {
  context_.watchdog.beat(phase);
  return context_.hook ? context_.hook(phase) : PhaseFault::none;
}

double RunLoop::frame_time(int frame) const {
  return frame / context_.scene.time.frame_rate;
}

double RunLoop::session_seconds() const {
  return seconds_since(context_.began);
}

RunEnd RunLoop::run() {
  try {
    const RunEnd end = advance();
    checkpoint();
    return end;
  } catch (const Error& error) {
    // Collective work needs all ranks here first.
    if (!context_.emergency.meet(int(error.code()), patience)) throw;
    save_after(error);
    throw;
  }
}

// Saves the state before the failed step. Another failure here must not hide the first error.
void RunLoop::save_after(const Error& error) {
  if (error.code() != ExitCode::cannot_continue && error.code() != ExitCode::output_failed) return;
  try {
    checkpoint();
  } catch (const Error& second) {
    context_.log.warn(fmt::format("the last good state could not be checkpointed: {}", second.what()));
  }
}

RunEnd RunLoop::advance() {
  begin();
  const TimeSpec& time = context_.scene.time;
  while (state_.frame < last_frame(time)) {
    const std::string stop = advance_to(frame_time(state_.frame + 1));
    if (is_reached(frame_time(state_.frame + 1))) write_frame();
    if (!stop.empty()) return {ExitCode::stopped, "stopped: " + stop};
    const bool due = state_.frame % std::max(1, context_.scene.output.checkpoint_every) == 0;
    if (due) checkpoint();
  }
  const std::string stop = advance_to(time.end);
  if (!stop.empty()) return {ExitCode::stopped, "stopped: " + stop};
  return {ExitCode::done, "finished"};
}

// The initial state is frame 0 and the first row of the tables.
void RunLoop::begin() {
  if (state_.frame >= 0 || context_.scene.time.end < 0) return;
  last_.wall_seconds = 0;
  account(last_);
  state_.initial_volume = last_.liquid_volume;
  tables_.add(last_, simulation_, state_);
  write_frame();
  checkpoint();
}

// True at `target`, with a tolerance for rounding of 1e-10 of the time between frames.
bool RunLoop::is_reached(double target) const {
  return simulation_.time() >= target - 1e-10 / context_.scene.time.frame_rate;
}

// Steps until `target` is reached or a stop is requested; returns the reason of the stop or "".
std::string RunLoop::advance_to(double target) {
  for (int steps = 0; !is_reached(target); ++steps) {
    if (steps == most_steps_a_frame) {
      throw Error(
          ExitCode::cannot_continue,
          fmt::format(
              "{} steps did not reach frame {} (t = {:g} s of {:g} s, last step {:g} s): the flow is too fast for "
              "this cell size and frame rate",
              steps, state_.frame + 1, simulation_.time(), target, last_.dt));
    }
    one_step(target);
    const std::string stop = stop_request();
    if (!stop.empty()) return stop;
  }
  return {};
}

void RunLoop::one_step(double target) {
  const auto start = std::chrono::steady_clock::now();
  visit("step");
  StepStats stats = simulation_.step(target);
  stats.wall_seconds = seconds_since(start);
  longest_step_ = std::max(longest_step_, stats.wall_seconds);
  if (visit("stats") == PhaseFault::poison) stats.kinetic_energy = std::nan("");
  const auto timer = own_timers_.measure("output");
  tables_.add(stats, simulation_, state_);
  account(stats);
  pass_on_warnings();
  progress_.step(stats, state_.frame + 1);
}

void RunLoop::account(const StepStats& stats) {
  last_ = stats;
  state_.step = stats.step;
  state_.time = stats.time;
  state_.liquid_volume = stats.liquid_volume;
  state_.expected_volume = simulation_.expected_volume();
  state_.volume_corrected = stats.volume_corrected;
  state_.worst_residual = std::max(state_.worst_residual, stats.solver_residual);
  state_.worst_divergence = std::max(state_.worst_divergence, stats.max_divergence);
  state_.rejected_steps += stats.rejected;
  state_.unconverged_separations += stats.separation_error > 0;
  state_.cells_liquid = double(stats.cells_liquid);
  state_.wall_seconds = earlier_seconds_ + session_seconds();
  state_.phase_seconds = earlier_phases_;
  for (const auto& [phase, seconds] : simulation_.timers().seconds()) state_.phase_seconds[phase] += seconds;
  for (const auto& [phase, seconds] : own_timers_.seconds()) state_.phase_seconds[phase] += seconds;
}

void RunLoop::pass_on_warnings() {
  for (const std::string& text : simulation_.take_warnings()) context_.log.warn(text);
  const DomainSpec& domain = context_.scene.domain;
  const std::string volume = volume_warning(state_, std::pow(domain.cell_size, context_.scene.dimension));
  if (!volume.empty() && !std::exchange(told_of_volume_, true)) context_.log.warn(volume);
}

void RunLoop::write_frame() {
  const PhaseFault fault = visit("frame");
  {
    const auto timer = own_timers_.measure("output");
    frames_.write({state_.frame + 1, simulation_.time(), last_.dt}, simulation_, fault);
  }
  ++state_.frame;
  tables_.sync();
  progress_.frame(last_, state_.frame);
  agree_on_root(context_.ranks, "writing the log", [&] { context_.log.flush(); });
}

void RunLoop::checkpoint() {
  const auto start = std::chrono::steady_clock::now();
  const PhaseFault fault = visit("checkpoint");
  tables_.sync();
  CheckpointData data = simulation_.save();
  if (fault == PhaseFault::poison && !data.fields.empty()) data.fields[0].values = {std::nan("")};
  store(state_, data);
  const CheckpointLabel label{state_.step, context_.scene.dimension, scene_hash(context_.scene)};
  write_checkpoint(context_.paths.checkpoints(), label, data, context_.ranks);
  longest_checkpoint_ = std::max(longest_checkpoint_, seconds_since(start));
}

std::string RunLoop::own_stop_request() const {
  if (const int number = context_.signals.received()) return signal_name(number);
  if (!context_.ranks.is_root()) return {};
  std::error_code ignored;
  if (std::filesystem::exists(context_.paths.stop(), ignored)) return "stop file";
  // The next step and the checkpoint must still fit into the remaining time.
  const double ahead = session_seconds() + longest_step_ + longest_checkpoint_;
  if (context_.walltime && ahead >= *context_.walltime) return fmt::format("wall time of {:g} s", *context_.walltime);
  return {};
}

// Stop request of the lowest rank that has one; the same on all ranks.
std::string RunLoop::stop_request() {
  const std::string mine = own_stop_request();
  if (!context_.ranks.any(!mine.empty())) return {};
  for (const std::string& reason : context_.ranks.all_gather(mine)) {
    if (reason.empty()) continue;
    if (context_.ranks.is_root()) {
      std::error_code ignored;
      std::filesystem::remove(context_.paths.stop(), ignored);
    }
    return reason;
  }
  return {};
}

}  // namespace seiche
