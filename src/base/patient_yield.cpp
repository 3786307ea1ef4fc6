// sched_yield() of this program, in place of libc's: waiting threads spin for a while before they give up their core.
//
// Open MPI calls sched_yield() in each turn of a waiting loop (mpi_yield_when_idle). Beside any other busy process the
// core then goes to that process for a time slice of some milliseconds, at each of the thousands of messages of a step.
// Messages between ranks that run take microseconds. Ranks that outnumber the cores must yield all the same.
// Figures: docs/decisions/0035-waiting-ranks.md.
#include "base/patient_yield.h"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

namespace seiche {
namespace {

using Clock = std::chrono::steady_clock;

std::chrono::microseconds patience{200};       // of spinning
constexpr std::chrono::microseconds pause{5};  // between calls: a longer one begins a new wait

thread_local Clock::time_point last_call, wait_begun;

// True if more ranks run on this machine than processors are free to them: a rank that spins then keeps another one
// from the work that it waits for.
bool ranks_outnumber_processors() {
  const char* ranks = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");  // set by mpirun
  cpu_set_t free_to_us;
  return ranks && sched_getaffinity(0, sizeof(free_to_us), &free_to_us) == 0 &&
         std::atoi(ranks) > CPU_COUNT(&free_to_us);
}

}  // namespace

bool is_patient() {
  const Clock::time_point now = Clock::now();
  if (now - last_call > pause) wait_begun = now;
  last_call = now;
  return now - wait_begun < patience;
}

void end_yield() {
  last_call = Clock::now();
}

void wait_patiently() {
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  if (ranks_outnumber_processors()) patience = patience.zero();
}

}  // namespace seiche

extern "C" int sched_yield() noexcept {
  if (seiche::is_patient()) return 0;
  const long result = syscall(SYS_sched_yield);
  seiche::end_yield();
  return int(result);
}
