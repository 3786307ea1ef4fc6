#pragma once
// Number of threads of each rank, and related environment variables.
#include <optional>
#include <string>

#include "base/communicator.h"
#include "run/log.h"

namespace seiche {

struct Threads {
  int count = 1;                // TBB threads of this rank
  std::string omp_num_threads;  // of rank 0's environment; "" if unset. Seiche itself does not use OpenMP.
};

// The requested number, or else the processors that this machine's ranks may use, divided among them. Warns if ranks
// times threads exceed these, and if OMP_NUM_THREADS differs between ranks, is not a number or is far above the
// hardware. Collective.
Threads choose_threads(std::optional<int> asked, const Communicator& ranks, RunLog& log);

}  // namespace seiche
