#pragma once
// How ranks part when something went wrong: an error that all ranks met together ends the program in an ordinary way,
// one that only some ranks met ends the whole job at once.
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

  // Called by a rank that failed. The codes of all ranks, if all of them call it within `patience` of each other;
  // nothing if some did not: they may wait for this rank elsewhere, and only abort() will end them.
  std::optional<std::vector<int>> meet(int code, std::chrono::milliseconds patience) const;

  // Ends the whole job with this code. Does not return.
  [[noreturn]] void abort(int code) const;

 private:
  MPI_Comm handle_ = MPI_COMM_NULL;
  // Members, not locals: an exchange that meet() gave up on may still write here.
  mutable int mine_ = 0;
  mutable std::vector<int> codes_;
};

// Ranks that share this rank's machine (its memory and its cores), this one included. Collective.
int ranks_on_this_machine(const Communicator& ranks);

// Processors of this machine that its ranks may run on, each counted once. Collective.
int processors_of_this_machine(const Communicator& ranks);

}  // namespace seiche
