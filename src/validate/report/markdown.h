#pragma once
// The report as a page of the documentation.
#include <string_view>

#include "validate/report/report.h"

namespace seiche {

constexpr std::string_view page_title = "# What was validated\n";  // its first line

std::string format_markdown(const Report& report);

// What it takes to run a case again, at the report's level.
std::string command_of(const Report& report, const CaseSpec& one);

// A text that may stand in a table.
std::string markdown_cell(const std::string& text);

// A figure of four digits, "-" for none.
std::string figure(const std::optional<double>& value);

// The same of seven digits: what is measured and what it should be may differ late.
std::string whole_figure(const std::optional<double>& value);

// Words on a case's misses and failures: the known cause, or that there is none. Of runs that passed or are not there
// what is known; empty where nothing is.
std::string words_on_misses(const std::vector<ReportedResult>& rows);

}  // namespace seiche
