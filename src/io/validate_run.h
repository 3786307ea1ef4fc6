#pragma once
// What the verb validate does: run cases, measure, judge.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/run_command.h"
#include "io/validate_case.h"
#include "io/validate_measures.h"

namespace seiche {

enum class Verdict { passed, missed, failed };  // failed: could not be run or measured

// One resolution of a case, run and judged.
struct CaseResult {
  Verdict verdict = Verdict::failed;
  Measurement measured;
  std::optional<double> order;  // of convergence from the resolution before; only where the case asks for one
  double cell_size = 0;         // m
  double wall_seconds = 0;
  std::string message;  // why it failed
  std::filesystem::path run;
};

struct ValidateOptions {
  std::vector<std::string> words;              // names and tags; none: all cases
  std::string level = "quick";                 // "quick" or "full"
  std::optional<std::filesystem::path> cases;  // unset: find_cases_folder()
  std::filesystem::path out = "out/validate";
  std::optional<int> threads;
};

// Writes one line a case to the console.
ExitCode list_cases(const ValidateOptions& options, const Surroundings& around);

// Runs the chosen cases in out/<case>/<resolution>/, prints a table row after each and keeps out/validation.json. Cases
// that could not go on are rows of the table. Returns done (all passed), bug (a bar was missed), cannot_continue (a
// case could not be run or measured), stopped. Throws Error(bad_input) before anything is run. Collective.
ExitCode validate_command(const ValidateOptions& options, const Surroundings& around);

// Passed or missed, by both bars.
Verdict judge(const CaseSpec& one, const ResolutionSpec& resolution, const CaseResult& result);

// log(e_coarse / e_fine) / log(h_coarse / h_fine); nothing for equal cells or errors that are not positive.
std::optional<double> observed_order(const CaseResult& coarse, const CaseResult& fine);

}  // namespace seiche
