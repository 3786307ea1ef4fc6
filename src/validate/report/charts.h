#pragma once
// What the report of a case shows beside its figures.
#include "validate/report/report.h"
#include "validate/report/svg.h"

namespace seiche {

// Errors over the cell size with bars and a slope; no curves where there are fewer than two cell sizes.
Chart error_chart(const std::vector<ReportedResult>& rows);

// Errors over their bars by the number of the run, where error_chart() shows none: runs that differ in other things
// than the cell size. No curves for fewer than two.
Chart share_chart(const std::vector<ReportedResult>& rows);

// What was measured over time, in all runs of the case, over the reference's series where the case has one.
Chart series_chart(const std::vector<ReportedResult>& rows);

// PNG of the last frame of a run; empty, with the reason, where it cannot be shown.
struct Picture {
  std::string png, reason;
};
Picture last_picture(const std::filesystem::path& run);

std::string base64(const std::string& bytes);

}  // namespace seiche
