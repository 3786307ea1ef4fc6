#pragma once
// One resolution of a validation case, run and judged.
#include <filesystem>
#include <optional>
#include <string>

#include "validate/measure/measures.h"
#include "validate/record/record.h"

namespace seiche {

// failed: could not be run or measured; absent: it was not asked to be run, and there is no earlier run
enum class Verdict { passed, missed, failed, absent };

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

}  // namespace seiche
