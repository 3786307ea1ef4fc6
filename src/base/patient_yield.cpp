// sched_yield() of this program, in place of libc's: waiting threads spin for a while before they give up their core.
//
// Open MPI calls sched_yield() in each turn of a waiting loop (mpi_yield_when_idle). Beside any other busy process the
// core then goes to that process for a time slice of some milliseconds, at each of the thousands of messages of a step.
// Messages between ranks that run take microseconds. Ranks that outnumber the cores must yield all the same.
// Figures: docs/decisions/0035-waiting-ranks.md.
#include "base/patient_yield.h"

#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

namespace seiche {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds patience{200};  // of spinning
constexpr std::chrono::microseconds pause{5};       // between calls: a longer one begins a new wait

thread_local Clock::time_point last_call, wait_begun;

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
}

}  // namespace seiche

extern "C" int sched_yield() noexcept {
  if (seiche::is_patient()) return 0;
  const long result = syscall(SYS_sched_yield);
  seiche::end_yield();
  return int(result);
}
