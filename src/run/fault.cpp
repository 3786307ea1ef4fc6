#include "run/fault.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <map>
#include <memory>
#include <new>
#include <regex>
#include <stdexcept>
#include <thread>

#include "base/error.h"

namespace seiche {
namespace {

const std::map<std::string, FaultKind>& kinds() {
  static const std::map<std::string, FaultKind> table{{"throw", FaultKind::exception},
                                                      {"nan", FaultKind::not_a_number},
                                                      {"badalloc", FaultKind::out_of_memory},
                                                      {"hang", FaultKind::hang},
                                                      {"kill", FaultKind::kill}};
  return table;
}

PhaseFault strike(const Injection& injection) {
  switch (injection.kind) {
    case FaultKind::exception:
      throw std::runtime_error("injected fault in phase " + injection.phase);
    case FaultKind::out_of_memory:
      throw std::bad_alloc();
    case FaultKind::hang:
      while (true) std::this_thread::sleep_for(std::chrono::seconds(1));
    case FaultKind::kill:
      std::raise(SIGKILL);
      return PhaseFault::none;
    default:
      return PhaseFault::poison;
  }
}

}  // namespace

Injection parse_injection(const std::string& text) {
  if (text.empty()) return {};
  static const std::regex pattern("([a-z]+):([0-9]{1,6}):([a-z]+)(:([0-9]{1,6})(\\+?))?");
  std::smatch parts;
  if (!std::regex_match(text, parts, pattern) || kinds().count(parts[3]) == 0) {
    throw Error(ExitCode::bad_input,
                fmt::format("--inject {}: expected phase:rank:kind or phase:rank:kind:nth, kind one of "
                            "throw, nan, badalloc, hang, kill",
                            text));
  }
  Injection injection{kinds().at(parts[3]), parts[1], std::stoi(parts[2]), 1, false};
  if (parts[4].matched) injection.first = std::stoi(parts[5]);
  injection.always = parts[6].length() > 0;
  return injection;
}

FaultHook make_fault_hook(const Injection& injection, int rank) {
  if (injection.kind == FaultKind::none || injection.rank != rank) {
    return [](const std::string&) { return PhaseFault::none; };
  }
  return [injection, visits = std::make_shared<int>(0)](const std::string& phase) {
    if (phase != injection.phase) return PhaseFault::none;
    ++*visits;
    const bool due = injection.always ? *visits >= injection.first : *visits == injection.first;
    return due ? strike(injection) : PhaseFault::none;
  };
}

}  // namespace seiche
