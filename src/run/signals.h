#pragma once
// Stop requests by signals.
#include <string>

namespace seiche {

// During its life SIGUSR1, SIGINT and SIGTERM only request a stop, and SIGXFSZ is ignored (a file beyond the limit then
// fails with EFBIG). A second SIGINT or SIGTERM ends the process. Signals noted before count. One object at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // Signal received on this rank, or 0.
  int received() const;
};

// Call on the first line of a program that runs simulations. SIGUSR1, SIGINT and SIGTERM are noted until a StopSignals
// takes over or the default handlers are restored (a noted signal is then raised again).
void note_stop_signals();
void restore_stop_signals();

// Signal received on this process since note_stop_signals(), or 0.
int noted_signal();

std::string signal_name(int number);

}  // namespace seiche
