#pragma once
// Requests to stop that come from outside the program.
#include <string>

namespace seiche {

// While it lives, SIGUSR1, SIGINT and SIGTERM only ask for a stop and SIGXFSZ is ignored (a file that grows over the
// limit then fails with EFBIG). A second SIGINT or SIGTERM ends the process in the ordinary way. Signals noted before
// count. One object at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // The signal that arrived on this rank, or 0.
  int received() const;
};

// From the first line of a program that runs simulations: SIGUSR1, SIGINT and SIGTERM are noted until a StopSignals
// takes over or they get their ordinary meaning back (one that was noted is then raised again).
void note_stop_signals();
void restore_stop_signals();

// The signal that arrived on this process since the handlers stand, or 0.
int noted_signal();

std::string signal_name(int number);

}  // namespace seiche
