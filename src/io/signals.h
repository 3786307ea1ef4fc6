#pragma once
// Requests to stop that come from outside the program.
#include <string>

namespace seiche {

// While it lives, SIGUSR1, SIGINT and SIGTERM only ask for a stop and SIGXFSZ is ignored (a file that grows over the
// limit then fails with EFBIG). A second SIGINT or SIGTERM ends the process in the ordinary way. One object at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  // The signal that arrived on this rank, or 0.
  int received() const;
};

std::string signal_name(int number);

}  // namespace seiche
