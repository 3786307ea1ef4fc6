#pragma once
// Notes for the log on solves that ended before or beside their tolerances. Empty: nothing to tell.
#include "coupling/state/attempt.h"

namespace seiche {

// `error`: of the search for cells where liquid separates from solids; 0: it converged.
std::string note_on_separation(std::int64_t step, double error);
std::string note_on_rounding(std::int64_t step, const SolveReport& solve, double tolerance);
template <int Dim>
std::string note_on_rheology(std::int64_t step, const Attempt<Dim>& attempt);

}  // namespace seiche
