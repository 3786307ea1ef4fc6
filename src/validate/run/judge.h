#pragma once
// How errors over resolutions are judged.
#include <optional>
#include <vector>

#include "validate/report/report.h"
#include "validate/run/plan.h"

namespace seiche {

// log(e_coarse / e_fine) / log(h_coarse / h_fine); nothing for equal cells or errors that are not positive.
std::optional<double> observed_order(const CaseResult& coarse, const CaseResult& fine);

// Least-squares slope of log e over log h of the results of a series; nothing for under two different cells or errors
// that are not positive.
std::optional<double> fitted_order(const std::vector<CaseResult>& results);

// Passed or missed: the error by its bar, the fitted order by the case's least one, the order from the resolution
// before by that less order_scatter. Orders that are not set are not judged.
Verdict judge(const CaseSpec& one, const ResolutionSpec& resolution, const CaseResult& result);

// Judges a result that was measured, with the results of its series that the report has already.
void judge_by_all(const Planned& run, const Report& report, CaseResult& result);

// After the last run of a series: where that has no figure, the last one that has is judged by the fit instead.
// Returns that row where this changed its verdict, else null.
const ReportedResult* judge_last_measured(Report& report);

}  // namespace seiche
