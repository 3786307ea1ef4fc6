#pragma once
// Judges errors and orders of convergence.
#include <optional>
#include <vector>

#include "validate/report/report.h"
#include "validate/run/plan.h"

namespace seiche {

// Observed order log(e_coarse / e_fine) / log(h_coarse / h_fine); empty for equal cell sizes and errors that are not
// positive.
std::optional<double> observed_order(const CaseResult& coarse, const CaseResult& fine);

// Least-squares slope of log e over log h of a series; empty for less than two distinct cell sizes and for errors that
// are not positive.
std::optional<double> fitted_order(const std::vector<CaseResult>& results);

// Passed or missed: the error against its bar, the fitted order against min_order, and the order from the previous
// resolution against min_order - order_scatter. Unset orders are not judged.
Verdict judge(const CaseSpec& one, const ResolutionSpec& resolution, const CaseResult& result);

// Judges a measured result together with the report's earlier results of its series.
void judge_by_all(const Planned& run, const Report& report, CaseResult& result);

// Call it after the last run of a series. If that run has no figure, the last one with a figure is judged by the fit
// instead. Returns that row if its verdict changed, else null.
const ReportedResult* judge_last_measured(Report& report);

}  // namespace seiche
