#pragma once
// What a validation is going to run.
#include "validate/run/run.h"

namespace seiche {

// One resolution of a case. Points into the cases it was planned from.
struct Planned {
  const CaseSpec* one;
  const ResolutionSpec* resolution;
  Scene scene;
  bool last_of_series = false;  // of the plan
  bool chosen = true;           // by the user; others are for the record's page
};

// The cases of the folder that the options name, or of the one that is found; warns of what is left out. Throws
// Error(bad_input). Collective.
std::vector<CaseSpec> read_all_cases(const ValidateOptions& options, const Surroundings& around);

// Those the user named. Throws Error(bad_input). Collective.
std::vector<CaseSpec> choose_cases(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                                   const Communicator& ranks);

// The chosen runs (single ones of any level) and, with a record, all others of the level. Reads every scene and checks
// the names that measures give, so that a mistake in the last case ends the program before the first is run. Throws
// Error(bad_input), where nothing is chosen too. Collective.
std::vector<Planned> plan(const std::vector<CaseSpec>& cases, const ValidateOptions& options,
                          const Communicator& ranks);

}  // namespace seiche
