#include "io/run_threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <thread>
#include <vector>

#include "base/emergency_channel.h"

namespace seiche {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

// The first number of a list such as "4,2"; 0 for what is none.
long leading_number(const std::string& text) {
  return std::strtol(text.c_str(), nullptr, 10);
}

void warn_about_openmp(const std::string& mine, int hardware, const Communicator& ranks, RunLog& log) {
  const std::vector<std::string> all = ranks.all_gather(mine);
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    if (all[rank] == all[0]) continue;
    log.warn(fmt::format("OMP_NUM_THREADS is '{}' on rank 0 and '{}' on rank {}; libraries may run unevenly", all[0],
                         all[rank], rank));
    break;
  }
  if (all[0].empty()) return;
  const long number = leading_number(all[0]);
  if (number < 1) {
    log.warn(fmt::format("OMP_NUM_THREADS is '{}', which is no number of threads", all[0]));
  } else if (number > 4L * hardware) {
    log.warn(fmt::format("OMP_NUM_THREADS is {} on a machine with {} hardware threads", number, hardware));
  }
}

}  // namespace

Threads choose_threads(std::optional<int> asked, const Communicator& ranks, RunLog& log) {
  const int hardware = std::max(1, int(std::thread::hardware_concurrency()));
  const int share = std::max(1, hardware / ranks_on_this_machine(ranks));
  Threads threads{asked.value_or(share), environment("OMP_NUM_THREADS")};
  warn_about_openmp(threads.omp_num_threads, hardware, ranks, log);
  threads.omp_num_threads = ranks.broadcast(threads.omp_num_threads);
  return threads;
}

}  // namespace seiche
