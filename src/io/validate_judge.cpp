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

}  // namespace seiche
