#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <clocale>
#include <cstdio>
#include <iostream>
#include <new>
#include <system_error>

#include "base/emergency_channel.h"
#include "base/version.h"
#include "command_line.h"
#include "console.h"
#include "run/signals.h"
#include "verbs.h"

namespace seiche {
namespace {

constexpr auto patience = std::chrono::seconds(3);

struct Failure {
  ExitCode code = ExitCode::bug;
  std::string message;
};

Failure current_failure(int rank) {
  try {
    throw;
  } catch (const Error& error) {
    return {error.code(), error.what()};
  } catch (const std::bad_alloc&) {
    return {ExitCode::machine, fmt::format("rank {}: out of memory", rank)};
  } catch (const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    if (system && system->code() == std::errc::resource_unavailable_try_again)  // for instance of a thread
      return {ExitCode::machine, fmt::format("rank {}: {}", rank, error.what())};
    return {ExitCode::bug, fmt::format("this is a bug of Seiche {} (rank {}): {}", version(), rank, error.what())};
  } catch (...) {
    return {ExitCode::bug, fmt::format("this is a bug of Seiche {} (rank {}): an unknown exception", version(), rank)};
  }
}

// Rank 0 reports an error that all ranks have. A rank that is alone with its error aborts the whole job.
int end_with(const Failure& failure, const Communicator& ranks, const EmergencyChannel& emergency) {
  const auto codes = emergency.meet(int(failure.code), patience);
  if (!codes) {
    print_error(failure.message);
    emergency.abort(int(failure.code));
  }
  if (ranks.is_root()) print_error(failure.message);
  return codes->front();
}

// Refuses empty option values, such as those of unset shell variables. Options that need no value have an empty one.
void require_words(const CLI::App& program) {
  for (const CLI::App* verb : program.get_subcommands()) {
    for (const CLI::Option* option : verb->get_options()) {
      if (option->get_expected_min() == 0) continue;
      for (const std::string& word : option->results()) {
        if (word.empty()) throw CLI::ValidationError(option->get_name(), "is empty");
      }
    }
  }
}

// The exit code if the command line alone decides it (help, version, mistakes), else -1.
int parse(CLI::App& program, int argc, char** argv, const Communicator& ranks) {
  try {
    program.parse(argc, argv);
    require_words(program);
    return -1;
  } catch (const CLI::ParseError& outcome) {
    if (outcome.get_exit_code() == 0) {
      if (ranks.is_root()) program.exit(outcome);
      return 0;
    }
    if (ranks.is_root()) print_error(describe_mistake(program, outcome, {argv + 1, argv + argc}));
    return int(ExitCode::bad_input);
  }
}

int run_program(int argc, char** argv, const Communicator& ranks, const EmergencyChannel& emergency) {
  CLI::App program("Seiche: liquid among moving and deforming solids", "seiche");
  program.set_version_flag("--version", fmt::format("seiche {} (build {})", version(), build_digest()));
  program.require_subcommand(1);
  VerbContext context{ranks, emergency, {}, Stops::at_once};
  for (const AddVerb add : verbs()) add(program, context);
  try {
    const int parsed = parse(program, argc, argv, ranks);
    if (parsed >= 0) return parsed;
    if (context.stops == Stops::at_once) restore_stop_signals();
    return int(context.action());
  } catch (...) {
    return end_with(current_failure(ranks.rank()), ranks, emergency);
  }
}

// MPI and thread libraries end silently, or crash, at the limit of address space (ulimit -v). Called before any library
// is initialised, so it may use the C library only.
void require_room_to_begin() {
  constexpr rlim_t least = rlim_t(300) << 20;  // a scene of 100 cells takes 260, mostly for libraries and threads
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || limit.rlim_cur >= least) return;
  std::array<char, 160> text{};
  const int length =
      std::snprintf(text.data(), text.size(),
                    "seiche: the limit of address space is %llu MiB (ulimit -v); Seiche takes %llu MiB to begin with\n",
                    (unsigned long long)(limit.rlim_cur >> 20), (unsigned long long)(least >> 20));
  (void)!write(STDERR_FILENO, text.data(), std::size_t(length));
  _exit(int(ExitCode::machine));
}

// The dynamic linker calls this before the libraries' own initialisers, some of which start threads.
[[gnu::section(".preinit_array"), gnu::used]] void (*before_libraries)() = require_room_to_begin;

}  // namespace
}  // namespace seiche

int main(int argc, char** argv) {
  seiche::note_stop_signals();
  std::setlocale(LC_ALL, "C");
  const seiche::MpiSession mpi(argc, argv);
  const seiche::Communicator ranks;
  const seiche::EmergencyChannel emergency(ranks);
  return seiche::run_program(argc, argv, ranks, emergency);
}
