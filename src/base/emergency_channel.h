#pragma once
// End of the program after an error. An error on all ranks ends it in the ordinary way. An error on only some ranks
// aborts the whole job at once.
#include <mpi.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/communicator.h"

namespace seiche {

class EmergencyChannel {
 public:
  explicit EmergencyChannel(const Communicator& ranks);  // collective
  ~EmergencyChannel();
  EmergencyChannel(const EmergencyChannel&) = delete;
  EmergencyChannel& operator=(const EmergencyChannel&) = delete;

  // Called by a rank that failed. Returns the codes of all ranks if all of them call it within `patience` of each
  // other. Returns nullopt if some did not: they may be waiting for this rank elsewhere, and only abort() ends them.
  std::optional<std::vector<int>> meet(int code, std::chrono::milliseconds patience) const;

  // Ends the whole job with this code. Does not return.
  [[noreturn]] void abort(int code) const;

 private:
  MPI_Comm handle_ = MPI_COMM_NULL;
  // Members, not locals: MPI may still write here after meet() gave up.
  mutable int mine_ = 0;
  mutable std::vector<int> codes_;
};

// Number of ranks on this rank's machine (sharing its memory and its cores), this one included. Collective.
int ranks_on_this_machine(const Communicator& ranks);

// Number of this machine's processors that its ranks may run on, each counted once. Collective.
int processors_of_this_machine(const Communicator& ranks);

// Waits begin with spinning only if each rank of this machine has a processor (patient_yield). Collective.
void choose_patience(const Communicator& ranks);

}  // namespace seiche
