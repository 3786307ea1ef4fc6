#pragma once
// A case's page of the documentation.
#include <string>
#include <vector>

#include "validate/report/report.h"

namespace seiche {

// Data shared by the pages of all cases.
struct PageContext {
  const Report& report;
  std::vector<std::string> machines;  // of all rows, numbered from 1
};

constexpr std::size_t short_digest = 8;  // leading characters of a build's digest: enough to distinguish builds

// The case's README, the measure, the command, the results, and settings and origin of each run.
std::string markdown_section(const PageContext& page, const std::vector<ReportedResult>& rows);

}  // namespace seiche
