// sched_yield() of this program, in place of libc's: waiting threads spin for a while, then yield, or sleep where other
// processes are busy.
//
// Open MPI calls sched_yield() in each turn of a waiting loop (mpi_yield_when_idle). Beside any other busy process the
// core then goes to that process for a time slice of some milliseconds, at each of the thousands of messages of a step.
// Messages between ranks that run take microseconds. Ranks that outnumber the cores must yield all the same. A thread
// that wakes from a short sleep gets its core back at once. Figures: docs/decisions/0035-waiting-ranks.md.
#include "base/patient_yield.h"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

namespace seiche {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds longest_spin{200};
constexpr std::chrono::microseconds pause{5};  // between calls: a longer one begins a new wait
std::chrono::microseconds patience = longest_spin;

constexpr std::chrono::microseconds nap{20};                                  // the system adds some 50
constexpr std::chrono::milliseconds slow_yield{1};                            // a shorter one met no other busy process
constexpr std::chrono::milliseconds shortest_trust{10}, longest_trust{1000};  // in the last slow yield

thread_local Clock::time_point last_call, wait_begun, naps_end;
thread_local std::chrono::milliseconds trust = shortest_trust;

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

void note_yield(std::chrono::microseconds took) {
  if (took >= slow_yield) naps_end = Clock::now() + trust;
  trust = std::clamp(took >= slow_yield ? 2 * trust : trust / 2, shortest_trust, longest_trust);
}

bool is_crowded() {
  return Clock::now() < naps_end;
}

void give_way() {
  if (is_crowded()) return std::this_thread::sleep_for(nap);
  const Clock::time_point before = Clock::now();
  syscall(SYS_sched_yield);
  note_yield(std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - before));
}

void wait_patiently() {
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
}

void spin_before_yields(bool spin) {
  patience = spin ? longest_spin : longest_spin.zero();
}

}  // namespace seiche

extern "C" int sched_yield() noexcept {
  if (seiche::is_patient()) return 0;
  seiche::give_way();
  seiche::end_yield();
  return 0;
}
