#include "io/validate_judge.h"

#include <cmath>

namespace seiche {

std::optional<double> observed_order(const CaseResult& coarse, const CaseResult& fine) {
  return fitted_order({coarse, fine});
}

std::optional<double> fitted_order(const std::vector<CaseResult>& results) {
  double h_mean = 0, e_mean = 0, hh = 0, he = 0;
  const double n = double(results.size());
  for (const CaseResult& r : results) {
    if (!(r.measured.error > 0) || !(r.cell_size > 0)) return std::nullopt;
    h_mean += std::log(r.cell_size) / n;
    e_mean += std::log(r.measured.error) / n;
  }
  bool same = true;
  for (const CaseResult& r : results) {
    same = same && r.cell_size == results[0].cell_size;
    const double dh = std::log(r.cell_size) - h_mean;
    hh += dh * dh;
    he += dh * (std::log(r.measured.error) - e_mean);
  }
  if (same || !std::isfinite(he / hh)) return std::nullopt;
  return he / hh;
}

Verdict judge(const CaseSpec& one, const ResolutionSpec& resolution, const CaseResult& result) {
  const std::optional<double> bar = max_error_of(one, resolution);
  const bool small = bar && result.measured.error <= *bar;
  const bool steep = !result.order || !one.min_order || *result.order >= *one.min_order - order_scatter;
  const bool fits = !result.fitted_order || !one.min_order || *result.fitted_order >= *one.min_order;
  return small && steep && fits ? Verdict::passed : Verdict::missed;
}

namespace {

bool same_series(const ReportedResult& row, const CaseSpec& one, const ResolutionSpec& resolution) {
  return row.one.name == one.name && reference_of(row.one, row.resolution) == reference_of(one, resolution);
}

// Those with figures among the last results of the report, as far back as they are to meet the same reference; coarse
// to fine.
std::vector<CaseResult> measured_before(const Report& report, const CaseSpec& one, const ResolutionSpec& resolution) {
  std::vector<CaseResult> found;
  for (auto row = report.results.rbegin(); row != report.results.rend(); ++row) {
    if (!same_series(*row, one, resolution)) break;
    if (is_measured(row->result)) found.insert(found.begin(), row->result);
  }
  return found;
}

}  // namespace

void judge_by_all(const Planned& run, const Report& report, CaseResult& result) {
  std::vector<CaseResult> all = measured_before(report, *run.one, *run.resolution);
  if (!all.empty()) result.order = observed_order(all.back(), result);
  all.push_back(result);
  if (run.last_of_reference) result.fitted_order = fitted_order(all);
  result.verdict = judge(*run.one, *run.resolution, result);
}

const ReportedResult* judge_last_measured(Report& report) {
  const ReportedResult& last = report.results.back();
  const std::vector<CaseResult> all = measured_before(report, last.one, last.resolution);
  if (is_measured(last.result) || all.empty()) return nullptr;
  auto row = report.results.rbegin();
  while (!is_measured(row->result)) ++row;
  const Verdict before = row->result.verdict;
  row->result.fitted_order = fitted_order(all);
  row->result.verdict = judge(row->one, row->resolution, row->result);
  return row->result.verdict == before ? nullptr : &*row;
}

}  // namespace seiche
