#include "validate/record/machine.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "run/memory.h"

namespace seiche {
namespace {

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string compiler() {
#ifdef __clang__
  return __VERSION__;
#else
  return std::string("g++ ") + __VERSION__;
#endif
}

}  // namespace

std::string describe_machine() {
  const unsigned cores = std::thread::hardware_concurrency();
  const double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE));
  return fmt::format("{}; {} core{}; {}; {}", processor(), cores, cores == 1 ? "" : "s", readable_bytes(memory),
                     compiler());
}

}  // namespace seiche
