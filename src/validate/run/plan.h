#pragma once
// Plan of a validation: its runs.
#include <memory>

#include "validate/run/run.h"

namespace seiche {

// One resolution of a case. Points into the cases of the plan.
struct Planned {
  const CaseSpec* one;
  const ResolutionSpec* resolution;
  std::shared_ptr<const Scene> scene;
  bool last_of_series = false;  // in this plan
  bool chosen = true;           // by the user; others are for the page of the record
};

// Reads the cases of the folder in the options, or of the default folder; warns about folders that are skipped. Throws
// Error(bad_input). Collective.
std::vector<CaseSpec> read_all_cases(const ValidateOptions& options, const Surroundings& around);

// Cases selected by the user. Throws Error(bad_input). Collective.
std::vector<CaseSpec> choose_cases(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                                   const Communicator& ranks);

// The selected runs (single ones of any level) and, with a record, all others of the level. Reads every scene and
// checks the names in the measures, so that a mistake in the last case ends the program before the first run. Throws
// Error(bad_input), also if nothing is selected. Collective.
std::vector<Planned> plan(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                          const Communicator& ranks);

}  // namespace seiche
