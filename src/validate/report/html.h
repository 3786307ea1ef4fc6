#pragma once
// Report as a single self-contained HTML page.
#include "validate/report/report.h"

namespace seiche {

// Tables, plots, pictures and the cases' README pages. Reads the runs and renders their last frames.
std::string format_html(const Report& report);

}  // namespace seiche
