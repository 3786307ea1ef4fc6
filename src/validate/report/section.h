#pragma once
// A case's section of the page of the documentation.
#include <string>
#include <vector>

#include "validate/report/report.h"

namespace seiche {

// What all sections share.
struct PageContext {
  const Report& report;
  std::vector<std::string> machines;  // of all rows, in the order of their numbers from 1
};

constexpr std::size_t short_digest = 8;  // of a build's digest: enough to tell builds apart

// The case's own page, what is measured, the command, its results, and what each run sets and was made by.
std::string markdown_section(const PageContext& page, const std::vector<ReportedResult>& rows);

}  // namespace seiche
