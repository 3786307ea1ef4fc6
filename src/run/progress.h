#pragma once
// Progress display of a run: a live line on a terminal, else one line a frame.
#include <chrono>
#include <cstdint>
#include <string>

#include "coupling/state/simulation.h"
#include "run/log.h"

namespace seiche {

struct ProgressScale {
  std::int64_t cells = 0;  // of the domain
  int last_frame = 0;
  double start = 0, end = 0;  // s, of this session
};

class Progress {
 public:
  Progress(RunLog& log, ProgressScale scale) : log_(log), scale_(scale) {}

  void step(const StepStats& stats, int frame);
  void frame(const StepStats& stats, int frame);

 private:
  std::string line(const StepStats& stats, int frame) const;

  RunLog& log_;
  ProgressScale scale_;
  std::int64_t steps_ = 0;  // of this session
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

std::string readable_seconds(double seconds);  // "1:02:03", "2:03", "3 s"

}  // namespace seiche
