#include "run/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "base/emergency_channel.h"

namespace seiche {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

// First number of a list such as "4,2"; 0 if it is not a number.
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
    log.warn(
        fmt::format("OMP_NUM_THREADS is '{}', but must be a whole number above 0; libraries may ignore it", all[0]));
  } else if (number > 4L * hardware) {
    log.warn(fmt::format("OMP_NUM_THREADS is {} on a machine with {} hardware threads", number, hardware));
  }
}

std::string counted(int n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

// Warns about the machine with most threads per processor.
void warn_about_crowding(int here, int threads, int processors, const Communicator& ranks, RunLog& log) {
  const double crowding = double(here) * threads / processors, most = ranks.global_max(crowding);
  if (most <= 1) return;
  const std::string mine = fmt::format("{} with {} each on {} of a machine", counted(here, "rank"),
                                       counted(threads, "thread"), counted(processors, "processor"));
  for (const std::string& text : ranks.all_gather(crowding == most ? mine : std::string())) {
    if (text.empty()) continue;
    log.warn(text + ": they compete for processors; use fewer ranks or threads");
    break;
  }
}

}  // namespace

Threads choose_threads(std::optional<int> asked, const Communicator& ranks, RunLog& log) {
  const int processors = processors_of_this_machine(ranks), here = ranks_on_this_machine(ranks);
  Threads threads{asked.value_or(std::max(1, processors / here)), environment("OMP_NUM_THREADS")};
  warn_about_openmp(threads.omp_num_threads, processors, ranks, log);
  warn_about_crowding(here, threads.count, processors, ranks, log);
  threads.omp_num_threads = ranks.broadcast(threads.omp_num_threads);
  return threads;
}

}  // namespace seiche
