#pragma once
// The one exception type of Seiche. Its code is the exit code of the program.
#include <stdexcept>
#include <string>

namespace seiche {

enum class ExitCode : int {
  done = 0,
  bug = 1,              // internal error, a bug in Seiche
  bad_input = 2,        // command line, scene or input file; nothing was run
  cannot_continue = 3,  // a numerical method failed; the last good step is checkpointed
  output_failed = 4,    // a file could not be written
  machine = 5,          // not enough memory, more unknowns than hypre's integers can count, MPI
  bad_checkpoint = 6,   // a checkpoint cannot be used
  stopped = 75,         // stopped on request; resume continues
  hung = 124            // a rank hung and the watchdog ended the run
};

// what() is one or two lines: the place, the error and its remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace seiche
