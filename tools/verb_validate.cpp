#include "console.h"
#include "validate/run/run.h"
#include "verbs.h"

namespace seiche {
namespace {

enum class Task { run, list };

struct ValidateWords {
  ValidateOptions options;
  Task task = Task::run;
};

// Options for input and output files.
void add_files(CLI::App* verb, ValidateOptions& options) {
  const CLI::Validator named([](const std::string& text) { return text.empty() ? "an empty name" : ""; }, "", "named");
  verb->add_option("--out", options.out, "Folder for the runs, validation.json and report.html")
      ->check(named)
      ->capture_default_str();
  verb->add_option("--cases", options.cases,
                   "Folder of the cases; default: ./validation, else the one that came with the program")
      ->check(named);
  verb->add_option("--write-docs", options.docs, "Write the report as Markdown to this file as well")->check(named);
  verb->add_option("--record", options.record,
                   "CSV file of figures of other builds and days: is brought up to date, and stands in for what is not "
                   "run; the page of --write-docs then has all cases")
      ->check(named);
}

}  // namespace

void add_validate(CLI::App& program, VerbContext& context) {
  CLI::App* verb = program.add_subcommand("validate", "Run analytic flows and benchmarks and compare with references");
  const auto words = std::make_shared<ValidateWords>();
  ValidateOptions& options = words->options;
  verb->add_option("case", options.words, "Names or tags of cases, or case/run for single runs; default: all");
  verb->add_option("--level", options.level, "quick: coarse, minutes; full: all resolutions")
      ->check(CLI::IsMember({"quick", "full"}))
      ->capture_default_str();
  verb->add_flag_callback(
      "--list", [words] { words->task = Task::list; }, "Show the cases and run nothing");
  add_files(verb, options);
  verb->add_option("--threads", options.threads, "Threads a rank; default: the machine's, shared among its ranks")
      ->check(CLI::Range(1, 4096));
  CLI::Option* fresh = verb->add_flag_callback(
      "--fresh", [&options] { options.earlier = Earlier::ignore; },
      "Run what was run before, too: an earlier run of the same scene, program and ranks else counts");
  verb->add_flag_callback(
          "--report-only", [&options] { options.making = Making::report; }, "Run nothing: report on the runs in --out")
      ->excludes(fresh);
  verb->add_option("--break", options.perturbation, "Test only: operator:factor")->group("");
  verb->footer(
      "Exit codes: 0 all cases passed; 1 a case missed its bar (the table and validation.json say "
      "which); 2 wrong command line, case or scene, nothing was run; 3 a case could not be run to its end or measured; "
      "others as for `seiche run`.");
  verb->callback([words, &context] {
    context.action = [words, &context] {
      const Surroundings around{context.ranks, context.emergency, terminal_console()};
      return words->task == Task::list ? list_cases(words->options, around) : validate_command(words->options, around);
    };
  });
}

}  // namespace seiche
