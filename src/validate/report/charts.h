#pragma once
// Charts and pictures of a case for the report.
#include "validate/report/report.h"
#include "validate/report/svg.h"

namespace seiche {

// Errors over cell size, with bars and a slope; no curves for less than two cell sizes.
Chart error_chart(const std::vector<ReportedResult>& rows);

// Errors relative to their bars by number of the run, for cases without error_chart(): runs that differ in other things
// than the cell size. No curves for less than two.
Chart share_chart(const std::vector<ReportedResult>& rows);

// Measured series of all runs of the case over time, with the series of the reference if there is one.
Chart series_chart(const std::vector<ReportedResult>& rows);

// PNG of a run's last frame; empty, with the reason, if it cannot be rendered.
struct Picture {
  std::string png, reason;
};
Picture last_picture(const std::filesystem::path& run);

}  // namespace seiche
