#include "fluid/volume/cell_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seiche {
namespace {

// |normal|/sum, ascending; in 2D the first is 0.
struct SortedNormal {
  std::array<double, 3> m{0, 0, 0};
  double sum = 0, below_origin = 0;  // sum of |n_a|; sum of the negative ones

  template <int Dim>
  explicit SortedNormal(const Vec<Dim>& n) {
    for (int a = 0; a < Dim; ++a) {
      m[std::size_t(a)] = std::abs(n[a]);
      sum += std::abs(n[a]);
      below_origin += std::min(n[a], 0.0);
    }
    for (double& x : m) x /= sum;
    std::sort(m.begin(), m.end());
    // Below this the cubic loses more by cancellation than it gains: the share errs by less than 1e-7.
    if (m[0] < 1e-7) m[0] = 0;
  }
};

// Share for 0 <= a <= 1/2 of the plane m.x = a, sum m = 1.
double lower_half(const std::array<double, 3>& m, double a) {
  const auto [m1, m2, m3] = m;
  const double m12 = m1 + m2, six = 6 * m1 * m2 * m3;
  const auto cube_at = [](double w, double x) { return w * w * (w - 3 * x); };
  if (a < m1) return a * a * a / six;
  if (a < m2) return (a * (a - m1) + m1 * m1 / 3) / (2 * m2 * m3);
  if (a < std::min(m12, m3)) return (a * a * (3 * m12 - a) + cube_at(m1, a) + cube_at(m2, a)) / six;
  if (m3 < m12) return (a * a * (3 - 2 * a) + cube_at(m1, a) + cube_at(m2, a) + cube_at(m3, a)) / six;
  return (2 * a - m12) / (2 * m3);
}

double share_of(const std::array<double, 3>& m, double a) {
  if (a <= 0) return 0;
  if (a >= 1) return 1;
  return a <= 0.5 ? lower_half(m, a) : 1 - lower_half(m, 1 - a);
}

}  // namespace

template <int Dim>
double share_below(const Vec<Dim>& normal, double offset) {
  const SortedNormal n(normal);
  return share_of(n.m, (offset - n.below_origin) / n.sum);
}

// Bisection and secant in turn: the share rises monotonically from 0 at 0 to 1/2 at 1/2.
template <int Dim>
double offset_of_share(const Vec<Dim>& normal, double share, double error) {
  const SortedNormal n(normal);
  const double wanted = std::min(share, 1 - share);
  double low = 0, high = 0.5, at_low = 0, at_high = 0.5;
  for (int k = 0; k < 100 && high - low > error; ++k) {
    double a = k % 3 == 2 ? 0.5 * (low + high) : low + (wanted - at_low) / (at_high - at_low) * (high - low);
    a = std::clamp(a, low, high);
    const double found = lower_half(n.m, a);
    if (std::abs(found - wanted) < error)
      low = high = a;
    else if (found < wanted)
      low = a, at_low = found;
    else
      high = a, at_high = found;
    if (at_high <= at_low) break;
  }
  const double a = 0.5 * (low + high);
  return n.below_origin + n.sum * (share <= 0.5 ? a : 1 - a);
}

#define SEICHE_INSTANTIATE(D)                            \
  template double share_below<D>(const Vec<D>&, double); \
  template double offset_of_share<D>(const Vec<D>&, double, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
