#pragma once
// Faults put into a run on purpose, to test that it ends well: `--inject phase:rank:kind[:nth[+]]`.
#include <string>

#include "coupling/state/simulation.h"

namespace seiche {

enum class FaultKind { none, exception, not_a_number, out_of_memory, hang, kill };

struct Injection {
  FaultKind kind = FaultKind::none;
  std::string phase;  // transport, geometry, solve, restore, frame, checkpoint, stats
  int rank = 0;
  int first = 1;        // the visit of the phase that is hit, counted from 1
  bool always = false;  // and every one after it
};

// "solve:1:nan", "frame:0:throw:3", "transport:0:nan:2+". Kinds: throw, nan, badalloc, hang, kill; "" is no injection.
// Throws Error(bad_input).
Injection parse_injection(const std::string& text);

// Counts the visits of the phase on this rank and strikes when its time has come: throws, kills or hangs the process,
// or answers PhaseFault::poison.
FaultHook make_fault_hook(const Injection& injection, int rank);

}  // namespace seiche
