#pragma once
// The report for people: one page that needs no other file.
#include "validate/report/report.h"

namespace seiche {

// Tables, plots, pictures and the cases' own pages. Reads the runs and renders pictures into them.
std::string format_html(const Report& report);

}  // namespace seiche
