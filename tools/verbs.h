#pragma once
// The verbs of the command line. A verb is one file tools/verb_<name>.cpp with an add_<name> function, declared here
// and listed in the table of tools/verbs.cpp. It adds its subcommand and options to the program's parser and, in the
// subcommand's callback, hands over what to do: `context.action = [options, &context] { return ...; };`.
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <vector>

#include "base/communicator.h"
#include "base/emergency_channel.h"
#include "base/error.h"

namespace seiche {

// When a signal ends a verb: at once, or where the verb itself looks for one.
enum class Stops { at_once, when_safe };

struct VerbContext {
  const Communicator& ranks;
  const EmergencyChannel& emergency;
  // Set by the verb that was chosen. Runs on every rank; returns the exit code or throws Error (the main program prints
  // it once and ends all ranks with its code).
  std::function<ExitCode()> action;
  Stops stops = Stops::at_once;
};

using AddVerb = void (*)(CLI::App&, VerbContext&);

// The table, in the order of --help.
const std::vector<AddVerb>& verbs();

void add_run(CLI::App& program, VerbContext& context);
void add_resume(CLI::App& program, VerbContext& context);
void add_check(CLI::App& program, VerbContext& context);
void add_validate(CLI::App& program, VerbContext& context);
void add_info(CLI::App& program, VerbContext& context);
void add_render(CLI::App& program, VerbContext& context);

}  // namespace seiche
