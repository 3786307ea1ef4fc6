#include "base/curves.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace seiche {
namespace {

struct Declared {
  std::deque<TimeCurve> all;  // never shortened: formulas hold addresses
  std::map<std::string, const TimeCurve*> by_name;
};

Declared& declared() {
  static Declared curves;
  return curves;
}

// Weighted harmonic mean of the slopes before and after a point; 0 at an extremum. h: lengths of the two intervals.
double slope_between(double before, double after, double h_before, double h_after) {
  if (before * after <= 0) return 0;
  const double w_before = h_before + 2 * h_after, w_after = 2 * h_before + h_after;
  return (w_before + w_after) / (w_before / before + w_after / after);
}

}  // namespace

// The ends have the slopes of their intervals.
void TimeCurve::set_slopes() {
  const std::size_t n = times.size();
  slopes.assign(n, 0);
  if (form != CurveForm::smooth || n < 2) return;
  const auto h = [&](std::size_t k) { return times[k + 1] - times[k]; };
  const auto secant = [&](std::size_t k) { return (values[k + 1] - values[k]) / h(k); };
  for (std::size_t k = 1; k + 1 < n; ++k) slopes[k] = slope_between(secant(k - 1), secant(k), h(k - 1), h(k));
  slopes[0] = secant(0);
  slopes[n - 1] = secant(n - 2);
}

double TimeCurve::operator()(double t) const {
  if (!(t > times.front())) return values.front();
  if (t >= times.back()) return values.back();
  const auto k = std::size_t(std::upper_bound(times.begin(), times.end(), t) - times.begin()) - 1;
  const double h = times[k + 1] - times[k], s = (t - times[k]) / h, a = values[k], b = values[k + 1];
  if (form == CurveForm::linear) return a + s * (b - a);
  const double rise = s * s * (3 - 2 * s);  // cubic Hermite polynomials
  return a + rise * (b - a) + h * s * (1 - s) * ((1 - s) * slopes[k] - s * slopes[k + 1]);
}

void declare_curves(const std::map<std::string, TimeCurve>& curves) {
  declared().by_name.clear();
  for (const auto& [name, curve] : curves) {
    declared().all.push_back(curve);
    declared().all.back().set_slopes();
    declared().by_name[name] = &declared().all.back();
  }
}

std::map<std::string, const TimeCurve*> declared_curves() {
  return declared().by_name;
}

}  // namespace seiche
