#pragma once
// Verbs of the command line. A verb is one file tools/verb_<name>.cpp with a function add_<name>, which is declared
// here and listed in the table of tools/verbs.cpp. The function adds the subcommand and its options to the program's
// parser. The subcommand's callback sets the action: `context.action = [options, &context] { return ...; };`.
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <vector>

#include "base/communicator.h"
#include "base/emergency_channel.h"
#include "base/error.h"

namespace seiche {

// Effect of a stop signal on a verb: it ends at once, or at a point that the verb chooses.
enum class Stops { at_once, when_safe };

struct VerbContext {
  const Communicator& ranks;
  const EmergencyChannel& emergency;
  // Action of the chosen verb. Runs on every rank; returns the exit code or throws Error. The main program prints an
  // error once and ends all ranks with its code.
  std::function<ExitCode()> action;
  Stops stops = Stops::at_once;
};

using AddVerb = void (*)(CLI::App&, VerbContext&);

// Table of verbs in the order of --help.
const std::vector<AddVerb>& verbs();

void add_init(CLI::App& program, VerbContext& context);
void add_run(CLI::App& program, VerbContext& context);
void add_resume(CLI::App& program, VerbContext& context);
void add_check(CLI::App& program, VerbContext& context);
void add_validate(CLI::App& program, VerbContext& context);
void add_info(CLI::App& program, VerbContext& context);
void add_render(CLI::App& program, VerbContext& context);
void add_plot(CLI::App& program, VerbContext& context);
void add_export(CLI::App& program, VerbContext& context);
void add_help(CLI::App& program, VerbContext& context);
void add_completion(CLI::App& program, VerbContext& context);
void add_manual(CLI::App& program, VerbContext& context);
void add_schema(CLI::App& program, VerbContext& context);

}  // namespace seiche
