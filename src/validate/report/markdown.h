#pragma once
// The report as pages of the documentation: a summary and a page for each case.
#include <string_view>

#include "validate/report/report.h"

namespace seiche {

// First lines, by which these pages are known.
constexpr std::string_view page_title = "# What was validated\n";
constexpr std::string_view case_page_title = "<!-- Written by seiche validate --write-docs -->\n";

struct CasePage {
  std::string file, text;  // "fsi3.md"
};

// The summary. Pages of cases lie in `folder`, such as "validation", beside it.
std::string format_markdown(const Report& report, const std::string& folder);

// The cases' pages, which link to the summary, such as "validation.md", in the folder above.
std::vector<CasePage> case_pages(const Report& report, const std::string& summary);

// Command that runs a case again at the report's level.
std::string command_of(const Report& report, const CaseSpec& one);

// Escapes a text for a table's cell.
std::string markdown_cell(const std::string& text);

// A figure with four digits; "-" if unset.
std::string figure(const std::optional<double>& value);

// A figure with seven digits: value and reference may differ late.
std::string whole_figure(const std::optional<double>& value);

// Text on a case's misses and failures: the known cause, or that none is known. For runs that passed or are absent the
// known remarks; empty if there are none.
std::string words_on_misses(const std::vector<ReportedResult>& rows);

}  // namespace seiche
