#pragma once
// How errors over resolutions are judged.
#include <optional>
#include <vector>

#include "io/validate_run.h"

namespace seiche {

// log(e_coarse / e_fine) / log(h_coarse / h_fine); nothing for equal cells or errors that are not positive.
std::optional<double> observed_order(const CaseResult& coarse, const CaseResult& fine);

// Least-squares slope of log e over log h of results that are to meet the same reference; nothing for under two
// different cells or errors that are not positive.
std::optional<double> fitted_order(const std::vector<CaseResult>& results);

// Passed or missed: the error by its bar, the fitted order by the case's least one, the order from the resolution
// before by that less order_scatter. Orders that are not set are not judged.
Verdict judge(const CaseSpec& one, const ResolutionSpec& resolution, const CaseResult& result);

}  // namespace seiche
