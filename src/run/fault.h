#pragma once
// Fault injection for tests of error handling: `--inject phase:rank:kind[:nth[+]]`.
#include <string>

#include "coupling/state/simulation.h"

namespace seiche {

enum class FaultKind { none, exception, not_a_number, out_of_memory, hang, kill };

struct Injection {
  FaultKind kind = FaultKind::none;
  std::string phase;  // transport, geometry, solve, restore, frame, checkpoint, stats
  int rank = 0;
  int first = 1;        // visit of the phase to hit, counted from 1
  bool always = false;  // also every later visit
};

// Parses "solve:1:nan", "frame:0:throw:3", "transport:0:nan:2+". Kinds: throw, nan, badalloc, hang, kill; "" is no
// injection. Throws Error(bad_input).
Injection parse_injection(const std::string& text);

// Counts visits of the phase on this rank. At the chosen visit it throws, kills or hangs the process, or returns
// PhaseFault::poison.
FaultHook make_fault_hook(const Injection& injection, int rank);

}  // namespace seiche
