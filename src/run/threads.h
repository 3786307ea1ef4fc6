#pragma once
// How many threads each rank works with, and what the environment says about it.
#include <optional>
#include <string>

#include "base/communicator.h"
#include "run/log.h"

namespace seiche {

struct Threads {
  int count = 1;                // TBB threads of this rank
  std::string omp_num_threads;  // of rank 0's environment; "" where unset. Seiche itself does not use OpenMP.
};

// What was asked for, or else the processors that this machine's ranks may use, shared among them. Warns when ranks
// times threads are more than these, and when OMP_NUM_THREADS differs between ranks, is not a number, or is far beyond
// the hardware. Collective.
Threads choose_threads(std::optional<int> asked, const Communicator& ranks, RunLog& log);

}  // namespace seiche
