#pragma once
// One run of a validation: an earlier one, or one that is made now, or its figures on record; and its measuring.
#include <optional>
#include <string>

#include "validate/record/cache.h"
#include "validate/record/record.h"
#include "validate/report/report.h"
#include "validate/run/plan.h"

namespace seiche {

// A validation under way. The cache is rank 0's, the record is read by all ranks.
struct Validation {
  const ValidateOptions& options;
  const Surroundings& around;
  RunCache cache;
  std::optional<ValidationRecord> record;

  void say(const std::string& text) const {
    if (around.ranks.is_root()) around.console.line(text);
  }
};

// Throws Error(bad_input) for a record that cannot be read. Collective.
Validation start(const ValidateOptions& options, const Surroundings& around);

// Obtains and measures a run; what could not go on, on all ranks together, is a result. Not judged: figures have the
// verdict `missed`. Returns done, or why the validation ends here. Collective.
ExitCode obtain(const Planned& run, Validation& v, CaseResult& result);

// What the record has of a run; absent where it has nothing.
CaseResult recorded_result(const Planned& run, const std::optional<ValidationRecord>& record);

// Brings the record up to date with a run that was made or found, a failure included. Collective.
void put_on_record(const Planned& run, Validation& v, const CaseResult& result);

}  // namespace seiche
