#pragma once
// Advances a simulation from frame to frame and writes its run directory.
#include <chrono>
#include <optional>
#include <string>

#include "base/emergency_channel.h"
#include "base/error.h"
#include "coupling/state/simulation.h"
#include "files/frames.h"
#include "files/run_directory.h"
#include "run/log.h"
#include "run/progress.h"
#include "run/signals.h"
#include "run/state.h"
#include "run/tables.h"
#include "run/watchdog.h"

namespace seiche {

struct Scene;
struct TimeSpec;

// Number of the last frame. Frame n is at t = n / frame_rate; the last one is at `end` or, within rounding, just above.
// -1 for end < 0.
int last_frame(const TimeSpec& time);

// References that a run uses; they must outlive the loop.
struct RunContext {
  const Scene& scene;
  const Communicator& ranks;
  const EmergencyChannel& emergency;
  const RunPaths& paths;
  RunLog& log;
  Watchdog& watchdog;
  const StopSignals& signals;
  FaultHook hook;                  // also called at the loop's own phases: frame, checkpoint, stats
  std::optional<double> walltime;  // s from `began`
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
};

struct RunEnd {
  ExitCode code = ExitCode::done;  // done or stopped
  std::string how;                 // "finished", "stopped: ..."
};

class RunLoop {
 public:
  // `state` belongs to the simulation: fresh (frame -1) or restored. Collective.
  RunLoop(Simulation& simulation, const RunContext& context, RunState state);

  ~RunLoop();
  RunLoop(const RunLoop&) = delete;
  RunLoop& operator=(const RunLoop&) = delete;

  // Runs to the end or to a stop request, with a checkpoint in both cases. Throws Error; for cannot_continue and
  // output_failed after trying to checkpoint the last good state. Collective.
  RunEnd run();
  const RunState& state() const { return state_; }

 private:
  RunEnd advance();
  void begin();
  bool is_reached(double target) const;
  std::string advance_to(double target);
  void one_step(double target);
  void write_frame();
  void checkpoint();
  void save_after(const Error& error);
  std::string stop_request();
  std::string own_stop_request() const;
  PhaseFault visit(const std::string& phase);
  void account(const StepStats& stats);
  void pass_on_warnings();
  double frame_time(int frame) const;
  double session_seconds() const;

  Simulation& simulation_;
  RunContext context_;
  RunState state_;
  RunTables tables_;
  FrameWriter frames_;
  Progress progress_;
  StepStats last_;
  double earlier_seconds_ = 0;  // wall time of earlier sessions
  std::map<std::string, double> earlier_phases_;
  Timers own_timers_;
  bool told_of_volume_ = false;
  double longest_step_ = 0, longest_checkpoint_ = 0;  // s of wall time, to stop before the limit
};

}  // namespace seiche
