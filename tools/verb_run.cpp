#include <fmt/format.h>

#include <limits>

#include "base/scene.h"
#include "console.h"
#include "run/command.h"
#include "verb_options.h"
#include "verbs.h"

namespace seiche {
namespace {

// A time of at least `least` seconds, within what scenes may hold.
CLI::Validator is_time(double least) {
  return CLI::Validator(
      [least](const std::string& text) {
        constexpr double largest = 1e15;
        double x = 0;
        const bool fits = CLI::detail::lexical_cast(text, x) && x >= least && x <= largest;  // false for nan
        return fits ? "" : fmt::format("must be a number of seconds from {:g} to {:g}; it is {}", least, largest, text);
      },
      "SECONDS");
}

void add_session_options(CLI::App& verb, SessionOptions& session) {
  verb.add_option("--frames", session.frames, "Number of the last frame")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  verb.add_option("--threads", session.threads, "Threads a rank; default: the machine's, shared among its ranks")
      ->check(CLI::Range(1, 4096));
  verb.add_option("--walltime", session.walltime, "Stop with a checkpoint before so many seconds have passed")
      ->check(is_time(0));
  verb.add_option("--watchdog", session.watchdog, "End the run after so many seconds without progress")
      ->envname("SEICHE_WATCHDOG")
      ->check(is_time(0.001))
      ->capture_default_str();
  verb.add_option("--inject", session.inject, "Test only: phase:rank:kind[:nth]")->group("");
  verb.add_option("--break", session.perturbation, "Test only: operator:factor")->group("");
  verb.add_flag_callback(
      "--quiet", [&session] { session.verbosity = Verbosity::quiet; }, "Print warnings and errors only");
}

}  // namespace

void add_set_option(CLI::App& verb, std::vector<Override>& overrides) {
  verb.add_option_function<std::vector<std::string>>(
          "--set",
          [&overrides](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) overrides.push_back(parse_override(text));
          },
          "Override a key of the scene: key.path=value (repeatable)")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
}

Surroundings surroundings(const VerbContext& context) {
  return {context.ranks, context.emergency, terminal_console()};
}

void add_run(CLI::App& program, VerbContext& context) {
  CLI::App* verb = program.add_subcommand("run", "Run a scene");
  const auto options = std::make_shared<RunOptions>();
  verb->add_option("scene", options->scene, "Scene file")->required();
  verb->add_option("--out", options->out, "Run directory; default: out/<scene name>");
  verb->add_flag_callback(
      "--overwrite", [options] { options->existing = ExistingOutput::overwrite; },
      "Replace the run that the directory holds, its frames, tables, checkpoints and pictures");
  add_set_option(*verb, options->overrides);
  add_session_options(*verb, options->session);
  verb->callback([options, &context] {
    context.stops = Stops::when_safe;
    context.action = [options, &context] { return run_command(*options, surroundings(context)); };
  });
}

void add_resume(CLI::App& program, VerbContext& context) {
  CLI::App* verb = program.add_subcommand("resume", "Continue a stopped, killed or finished run");
  const auto options = std::make_shared<ResumeOptions>();
  verb->add_option("directory", options->folder, "Run directory, such as out/<scene name>")->required();
  verb->add_option("--end", options->end, "New end time, s")->check(is_time(0));
  add_set_option(*verb, options->overrides);
  verb->add_flag_callback(
      "--force", [options] { options->edits = EditPolicy::force; },
      "Accept changes of output and probes, in scene.toml or by --set, and damaged tables");
  add_session_options(*verb, options->session);
  verb->callback([options, &context] {
    context.stops = Stops::when_safe;
    context.action = [options, &context] { return resume_command(*options, surroundings(context)); };
  });
}

}  // namespace seiche
