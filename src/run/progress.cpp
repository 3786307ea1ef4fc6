#include "run/progress.h"

#include <fmt/format.h>

#include <algorithm>

namespace seiche {

std::string readable_seconds(double seconds) {
  if (!(seconds < 1e9)) return "long";
  const auto whole = std::int64_t(std::max(0.0, seconds) + 0.5);
  const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  if (hours > 0) return fmt::format("{}:{:02d}:{:02d}", hours, minutes, rest);
  if (minutes > 0) return fmt::format("{}:{:02d}", minutes, rest);
  return fmt::format("{} s", rest);
}

std::string Progress::line(const StepStats& s, int frame) const {
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  std::string text = fmt::format("frame {}/{}  t = {:.4g} s", frame, scale_.last_frame, s.time);
  if (steps_ == 0) return text;
  const double done = (s.time - scale_.start) / std::max(scale_.end - scale_.start, 1e-300);
  text += fmt::format("  dt = {:.2e} s  step {}  {} iterations  {:.2e} cells/s", s.dt, s.step, s.solver_iterations,
                      double(scale_.cells) * double(steps_) / std::max(elapsed, 1e-9));
  if (done > 0) text += fmt::format("  {} left", readable_seconds(elapsed * std::max(0.0, 1 / done - 1)));
  return text;
}

void Progress::step(const StepStats& stats, int frame) {
  ++steps_;
  log_.live(line(stats, frame));
}

void Progress::frame(const StepStats& stats, int frame) {
  const std::string text = line(stats, frame);
  if (log_.has_live_line()) {
    log_.live(text);
    log_.record(text);
  } else {
    log_.note(text);
  }
}

}  // namespace seiche
