#include "validate/run/judge.h"

#include <algorithm>
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

// True if a row has a figure in the series of this run.
bool has_figure_of(const ReportedResult& row, const CaseSpec& one, const ResolutionSpec& resolution) {
  return row.one.name == one.name && same_series(one, row.resolution, resolution) && is_measured(row.result);
}

// Figures of the run's series, coarse to fine.
std::vector<CaseResult> figures_of(const Report& report, const CaseSpec& one, const ResolutionSpec& resolution) {
  std::vector<CaseResult> found;
  for (const ReportedResult& row : report.results)
    if (has_figure_of(row, one, resolution)) found.push_back(row.result);
  return found;
}

}  // namespace

void judge_by_all(const Planned& run, const Report& report, CaseResult& result) {
  std::vector<CaseResult> all = figures_of(report, *run.one, *run.resolution);
  if (!all.empty()) result.order = observed_order(all.back(), result);
  all.push_back(result);
  if (run.last_of_series) result.fitted_order = fitted_order(all);
  result.verdict = judge(*run.one, *run.resolution, result);
}

const ReportedResult* judge_last_measured(Report& report) {
  const ReportedResult last = report.results.back();
  if (is_measured(last.result)) return nullptr;
  const auto row = std::find_if(report.results.rbegin(), report.results.rend(),
                                [&](const ReportedResult& r) { return has_figure_of(r, last.one, last.resolution); });
  if (row == report.results.rend()) return nullptr;
  const Verdict before = row->result.verdict;
  row->result.fitted_order = fitted_order(figures_of(report, last.one, last.resolution));
  row->result.verdict = judge(row->one, row->resolution, row->result);
  return row->result.verdict == before ? nullptr : &*row;
}

}  // namespace seiche
