#pragma once
// Obtains one run of a validation (an earlier one, a new one, or its recorded figures) and measures it.
#include <optional>
#include <string>

#include "validate/record/cache.h"
#include "validate/record/record.h"
#include "validate/report/report.h"
#include "validate/run/plan.h"

namespace seiche {

// A validation in progress. The cache belongs to rank 0; all ranks read the record.
struct Validation {
  const ValidateOptions& options;
  const Surroundings& around;
  RunCache cache;
  std::optional<ValidationRecord> record;

  void say(const std::string& text) const {
    if (around.ranks.is_root()) around.console.line(text);
  }
};

// Throws Error(bad_input) for an unreadable record. Collective.
Validation start(const ValidateOptions& options, const Surroundings& around);

// Obtains and measures a run. A simulation that cannot continue, on all ranks together, is a result. Figures get the
// verdict `missed` until they are judged. Returns done, or the reason why the validation ends here. Collective.
ExitCode obtain(const Planned& run, Validation& v, CaseResult& result);

// Recorded result of a run; absent if there is none.
CaseResult recorded_result(const Planned& run, const std::optional<ValidationRecord>& record);

// Updates the record with a run that was made or found, failures included. Collective.
void put_on_record(const Planned& run, Validation& v, const CaseResult& result);

}  // namespace seiche
