// A waiting thread spins for 200 us, then yields, or sleeps beside other busy processes. The program's sched_yield() is
// the one that libraries call.
#include "base/patient_yield.h"

#include <catch2/catch.hpp>

#include <dlfcn.h>
#include <sched.h>

#include <chrono>
#include <thread>

namespace patient_yield_tests {
using namespace seiche;

namespace {

using Clock = std::chrono::steady_clock;

// Seconds of back-to-back calls until one is not patient.
double seconds_of_patience() {
  const Clock::time_point start = Clock::now();
  while (is_patient()) continue;
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

TEST_CASE("a wait is patient for 200 us, and the next one again") {
  for (int wait = 0; wait < 3; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));  // work between two waits
    CHECK(seconds_of_patience() >= 200e-6);
    // Still the same wait, unless the system took the core away between the two calls.
    int same = 0;
    for (int i = 0; i < 100; ++i) {
      end_yield();
      same += !is_patient();
    }
    CHECK(same > 0);
  }
}

// Times of the clock, not of a processor: a machine that is busy makes them longer, never shorter.
TEST_CASE("after a yield that went to another process, waits sleep; for longer each time") {
  using std::chrono::milliseconds;
  const auto crowded_for = [] {
    const Clock::time_point start = Clock::now();
    while (is_crowded()) std::this_thread::sleep_for(milliseconds(1));
    return Clock::now() - start;
  };
  for (int n = 0; n < 10; ++n) note_yield(std::chrono::microseconds(1));
  CHECK_FALSE(is_crowded());
  for (const int expected : {10, 20, 40}) {
    note_yield(milliseconds(3));
    CHECK(crowded_for() > milliseconds(expected - 1));
  }
  note_yield(std::chrono::microseconds(1));
  CHECK_FALSE(is_crowded());
  note_yield(milliseconds(3));  // 80 ms, halved once
  CHECK(crowded_for() > milliseconds(39));

  note_yield(milliseconds(3));
  const Clock::time_point start = Clock::now();
  give_way();
  CHECK(Clock::now() - start >= std::chrono::microseconds(20));
}

TEST_CASE("libraries call the program's sched_yield") {
  wait_patiently();
  Dl_info found{}, here{};
  REQUIRE(dladdr(dlsym(RTLD_DEFAULT, "sched_yield"), &found) != 0);
  REQUIRE(dladdr(reinterpret_cast<void*>(&seconds_of_patience), &here) != 0);
  CHECK(found.dli_fbase == here.dli_fbase);
}

}  // namespace patient_yield_tests
