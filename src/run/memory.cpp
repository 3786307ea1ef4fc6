#include "run/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <fstream>
#include <limits>
#include <map>

#include "base/error.h"

namespace seiche {
namespace {

constexpr double kibibyte = 1024;

// Values of "Name:   123 kB" lines, in bytes.
std::map<std::string, double> kilobyte_lines(const char* file) {
  std::map<std::string, double> values;
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos || !line.ends_with("kB")) continue;
    values[line.substr(0, colon)] = std::strtod(line.c_str() + colon + 1, nullptr) * kibibyte;
  }
  return values;
}

double address_space_left() {
  struct rlimit limit {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return std::numeric_limits<double>::infinity();
  }
  return double(limit.rlim_cur) - kilobyte_lines("/proc/self/status")["VmSize"];
}

}  // namespace

MachineMemory machine_memory() {
  auto facts = kilobyte_lines("/proc/meminfo");
  const double unknown = std::numeric_limits<double>::infinity();
  const auto value = [&](const char* name) { return facts.count(name) != 0 ? facts[name] : unknown; };
  return {value("MemTotal") + (facts.count("SwapTotal") != 0 ? facts["SwapTotal"] : 0), value("MemAvailable"),
          address_space_left()};
}

double peak_resident_bytes() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) * kibibyte;
}

std::string readable_bytes(double bytes) {
  static constexpr const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  std::size_t unit = 0;
  while (bytes >= kibibyte && unit + 1 < std::size(units)) {
    bytes /= kibibyte;
    ++unit;
  }
  return fmt::format("{:.{}f} {}", bytes, unit == 0 ? 0 : 1, units[unit]);
}

void check_memory(const Cost& cost, int ranks, int ranks_here, const MachineMemory& memory) {
  const double share = cost.bytes / ranks, here = share * ranks_here;
  const std::string need =
      fmt::format("the grid has {} cells and needs about {} on this machine", cost.cells, readable_bytes(here));
  const char* remedy = "choose a larger cell_size or more machines";
  if (here > memory.total) {
    throw Error(ExitCode::bad_input, fmt::format("{}, but it has {}; {}", need, readable_bytes(memory.total), remedy));
  }
  if (here > memory.available) {
    throw Error(ExitCode::machine,
                fmt::format("{}, but {} are free now; {}", need, readable_bytes(memory.available), remedy));
  }
  if (share > memory.address_limit) {
    throw Error(ExitCode::machine,
                fmt::format("out of memory while reserving the grid: it has {} cells and needs about {} in "
                            "this process, but its limit leaves {}; raise the limit (ulimit -v) or choose a larger "
                            "cell_size",
                            cost.cells, readable_bytes(share), readable_bytes(memory.address_limit)));
  }
}

}  // namespace seiche
