#pragma once
// Table and validation.json of a validation.
#include <cstddef>
#include <string>
#include <vector>

#include "validate/case/case.h"
#include "validate/report/result.h"

namespace seiche {

struct ReportedResult {
  CaseSpec one;
  ResolutionSpec resolution;
  CaseResult result;
  std::string unit{};  // of the figure, see validate/measure/quantity.h
};

struct Report {
  std::string level;
  int ranks = 1;
  std::size_t planned = 0;              // total number of runs to be made
  std::vector<ReportedResult> results;  // results of one case are adjacent
  std::string perturbation;             // operators broken for a test; empty: none
  std::string machine;                  // the present one, see validate/record/machine.h
};

std::string verdict_name(Verdict verdict);  // "pass", "MISS", "FAILED", "not run"
bool is_measured(const CaseResult& result);

// The results of each case, in order.
std::vector<std::vector<ReportedResult>> by_case(const Report& report);

// Widths of the first two columns.
struct TableWidths {
  std::size_t name = 4, resolution = 10;
};

std::string table_header(const TableWidths& widths);
std::string table_row(const TableWidths& widths, const ReportedResult& row);
std::string table_summary(const Report& report);  // "12 pass, 1 MISS"

std::string format_report(const Report& report);  // JSON

}  // namespace seiche
