#pragma once
// The verb validate: runs cases, measures and judges them.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/command.h"
#include "validate/case/case.h"
#include "validate/record/cache.h"
#include "validate/report/result.h"

namespace seiche {

enum class Making { runs, report };  // report: only from existing runs

struct ValidateOptions {
  std::vector<std::string> words;              // names, tags and case/run; none: all cases
  std::string level = "quick";                 // "quick" or "full"
  std::optional<std::filesystem::path> cases;  // unset: find_cases_folder()
  std::filesystem::path out = "out/validate";
  std::optional<int> threads;
  Earlier earlier = Earlier::use;
  Making making = Making::runs;
  std::optional<std::filesystem::path> docs;    // file for the report as Markdown
  std::optional<std::filesystem::path> record;  // figures of other builds and days, see validate/record/record.h
  std::string perturbation;                     // see coupling/state/operator_perturbation.h
};

// Prints one line a case to the console.
ExitCode list_cases(const ValidateOptions& options, const Surroundings& around);

// Runs the selected cases in out/<case>/<resolution>/ unless a run exists, prints a table row after each, updates
// out/validation.json and writes out/report.html. With a record: updates it and takes figures of other runs from it;
// the Markdown page then has all cases of the level. Cases that cannot continue are rows of the table. Returns done
// (all passed), bug (a bar was missed), cannot_continue (a case could not be run or measured, or is absent), stopped.
// Throws Error(bad_input) before anything is run, and Error(output_failed) if the record or the page could not be
// written. Collective.
ExitCode validate_command(const ValidateOptions& options, const Surroundings& around);

}  // namespace seiche
