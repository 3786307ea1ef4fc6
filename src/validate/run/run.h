#pragma once
// What the verb validate does: run cases, measure, judge.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/command.h"
#include "validate/case/case.h"
#include "validate/measure/measures.h"
#include "validate/record/cache.h"
#include "validate/record/record.h"

namespace seiche {

// failed: could not be run or measured; absent: it was not asked to be run, and there is no earlier run
enum class Verdict { passed, missed, failed, absent };

// One resolution of a case, run and judged.
struct CaseResult {
  Verdict verdict = Verdict::failed;
  Measurement measured;
  std::optional<double> order;         // of convergence from the run before in its series
  std::optional<double> fitted_order;  // over all of the series, at its last run
  double cell_size = 0;                // m
  double wall_seconds = 0;             // of the run, whenever it was made
  bool cached = false;                 // an earlier run was taken
  bool recorded = false;               // only its figures are there
  Origin origin;                       // of the run
  std::string message;                 // why it failed
  std::filesystem::path run;
};

enum class Making { runs, report };  // report: of the runs that there are

struct ValidateOptions {
  std::vector<std::string> words;              // names and tags; none: all cases
  std::string level = "quick";                 // "quick" or "full"
  std::optional<std::filesystem::path> cases;  // unset: find_cases_folder()
  std::filesystem::path out = "out/validate";
  std::optional<int> threads;
  Earlier earlier = Earlier::use;
  Making making = Making::runs;
  std::optional<std::filesystem::path> docs;    // where to write the report as Markdown
  std::optional<std::filesystem::path> record;  // figures of other builds and days, see validate_record.h
  std::string tampering;                        // see coupling/state/tampering.h
};

// Writes one line a case to the console.
ExitCode list_cases(const ValidateOptions& options, const Surroundings& around);

// Runs the chosen cases in out/<case>/<resolution>/ as far as they have no run yet, prints a table row after each,
// keeps out/validation.json and writes out/report.html. With a record it brings that up to date, takes from it what is
// not run, and the Markdown page has all cases of the level. Cases that could not go on are rows of the table. Returns
// done (all passed), bug (a bar was missed), cannot_continue (a case could not be run or measured, or is absent),
// stopped. Throws Error(bad_input) before anything is run, and Error(output_failed) where the record or the page could
// not be written. Collective.
ExitCode validate_command(const ValidateOptions& options, const Surroundings& around);

}  // namespace seiche
