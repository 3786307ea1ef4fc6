#pragma once
// Rows of stats.csv, solids.csv and probes.csv. Numbers carry 17 digits, so that they read back to the same bits.
#include <string>

#include "coupling/state/simulation.h"

namespace seiche {

std::string stats_header();
std::string stats_row(const StepStats& stats);

std::string solids_header();
std::string solids_row(double time, const SolidState& solid);

std::string probes_header();
// Scalars fill `value`, vectors x, y, z; the rest stays empty, and all of it for an undefined sample.
std::string probes_row(double time, const ProbeSample& sample);

// The name of the first number of the row that is not finite, or "".
std::string not_finite(const StepStats& stats);
std::string not_finite(const SolidState& solid);
std::string not_finite(const ProbeSample& sample);

}  // namespace seiche
