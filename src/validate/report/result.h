#pragma once
// Result and verdict of one resolution of a validation case.
#include <filesystem>
#include <optional>
#include <string>

#include "validate/measure/measures.h"
#include "validate/record/record.h"

namespace seiche {

// failed: could not be run or measured; absent: not requested, and there is no earlier run
enum class Verdict { passed, missed, failed, absent };

struct CaseResult {
  Verdict verdict = Verdict::failed;
  Measurement measured;
  std::optional<double> order;         // of convergence, relative to the previous run of its series
  std::optional<double> fitted_order;  // over the whole series; set at its last run
  double cell_size = 0;                // m
  double wall_seconds = 0;             // of the run, also of an earlier one
  bool cached = false;                 // reused an earlier run
  bool recorded = false;               // only the recorded figures exist
  Origin origin;                       // of the run
  std::string message;                 // reason of a failure
  std::filesystem::path run;
};

}  // namespace seiche
