#include "fluid/transport/medial_axis.h"

#include <algorithm>
#include <numeric>

#include "grid/interpolation.h"

namespace seiche {
namespace {

// Thresholds of the detector, in h: a medial axis is detected above them and has full weight from twice them on.
// least_turn: difference of the slopes p3 - p2 and p1 - p0, as at a surface of radius 2 h. least_difference: difference
// of the second differences at p1 and p2, as at a surface of radius 3 h.
constexpr double least_turn = 1, least_difference = 0.125;
// One-sided interpolation has full weight up to this distance from the zero, none from one cell farther (cells). Values
// farther away do not move the zero.
constexpr double reach = 1;
// Up to this distance from the zero a crease is a corner of the liquid; from twice this on it is a medial axis (cells).
constexpr double corner = 0.15;

// Second differences at p1 and p2, and the detector's weight: 0 smooth, 1 medial axis between p0 and p3.
struct Bend {
  double d1, d2, share;
};
Bend bend(double p0, double p1, double p2, double p3, double h) {
  const double d1 = p0 - 2 * p1 + p2, d2 = p1 - 2 * p2 + p3;
  const double most = std::max(std::abs(d1 + d2) / least_turn, std::abs(d1 - d2) / least_difference) / h;
  return {d1, d2, std::clamp(most - 1, 0.0, 1.0)};
}

// Extends the lines through p0, p1 (value `low`) and p2, p3 (value `high`) to the point between p1 and p2. At a ridge
// (d1, d2 < 0) the result is the lower line if it is above q, in a valley the higher line if it is below q. Near the
// zero the result is q: there a crease is a corner of the liquid, which extended lines would lengthen step by step.
double beyond(double q, double low, double high, const Bend& b, double h) {
  double k = q;
  if (b.d1 < 0 && b.d2 < 0) k = std::max(q, std::min(low, high));
  if (b.d1 > 0 && b.d2 > 0) k = std::min(q, std::max(low, high));
  return q + std::clamp((std::abs(k) / h - corner) / corner, 0.0, 1.0) * (k - q);
}

// The second difference m of smaller magnitude. Where the other one is its opposite but for rounding, as at the centres
// of symmetric shapes, rounding would choose between m and -m: there m fades to 0.
double smaller_difference(const Bend& b) {
  constexpr double steepness = 1e6;
  const bool first = std::abs(b.d1) < std::abs(b.d2);
  const double m = first ? b.d1 : b.d2, other = first ? b.d2 : b.d1;
  return m * other < 0 ? m * std::min(1.0, steepness * (1 + m / other)) : m;
}

// Interpolates at fraction t between p1 and p2. The cubic through all four points is
//   c = l + t (t - 1)/6 ((2 - t) d1 + (1 + t) d2),  l = p1 + t (p2 - p1).
// Across a medial axis it is too low in the middle of threads and too high in that of gaps, by up to h/8 at their
// surface. The one-sided parabola (ENO, Harten et al. 1987) is
//   q = l + t (t - 1)/2 m,  m by smaller_difference().
// The one-sided value is q if the medial axis is outside [p1, p2]; else it follows the lines from both sides to their
// intersection (subcell resolution, Harten 1989). The result blends from c to it by b.share.
double interpolate_with_medial_axis(const std::array<double, 4>& p, double t, double h) {
  const Bend b = bend(p[0], p[1], p[2], p[3], h);
  const double line = p[1] + t * (p[2] - p[1]), cubic = line + t * (t - 1) / 6 * ((2 - t) * b.d1 + (1 + t) * b.d2);
  if (b.share == 0) return cubic;
  const double one_sided = line + t * (t - 1) / 2 * smaller_difference(b);
  const double low = p[1] + t * (p[1] - p[0]), high = p[2] + (1 - t) * (p[2] - p[3]);
  return cubic + b.share * (beyond(one_sided, low, high, b, h) - cubic);
}

// Interpolates along the axes in turn; order[0] is the outermost. p is the second point along each axis.
template <int Dim>
double interpolate_in_order(const Layout<Dim>& layout, const double* p, const Vec<Dim>& t,
                            const std::array<int, Dim>& order, int level = 0) {
  if (level == Dim) return *p;
  const int axis = order[std::size_t(level)];
  std::array<double, 4> v;
  for (int k = 0; k < 4; ++k)
    v[std::size_t(k)] = interpolate_in_order<Dim>(layout, p + (k - 1) * layout.stride(axis), t, order, level + 1);
  return interpolate_with_medial_axis(v, t[axis], layout.h());
}

// True if any of the stencil's lines of four points along an axis crosses a medial axis.
template <int Dim>
bool meets_medial_axis(const Layout<Dim>& layout, const double* p) {
  constexpr int lines = Dim == 2 ? 4 : 16;
  for (int axis = 0; axis < Dim; ++axis) {
    const Site d = layout.stride(axis), e = layout.stride((axis + 1) % Dim), f = layout.stride((axis + Dim - 1) % Dim);
    for (int n = 0; n < lines; ++n) {
      const double* q = p + (n % 4 - 1) * e + (Dim == 3 ? (n / 4 - 1) * f : 0);
      if (bend(q[-d], q[0], q[d], q[2 * d], layout.h()).share > 0) return true;
    }
  }
  return false;
}

}  // namespace

// At the medial axis the result depends on the order of the axes; the mean over all orders is symmetric.
template <int Dim>
double interpolate_beside_medial_axis(const Layout<Dim>& layout, const double* phi, const Vec<Dim>& g) {
  const double cubic = interpolate_cubic<Dim>(layout, phi, g);
  const double near = std::clamp(reach + 1 - std::abs(cubic) / layout.h(), 0.0, 1.0);
  if (near == 0) return cubic;
  Vec<Dim> t;
  const double* p = phi + detail::base_site<Dim>(layout, g, 1, 2, t);
  if (!meets_medial_axis(layout, p)) return cubic;
  std::array<int, Dim> order;
  std::iota(order.begin(), order.end(), 0);
  double sum = 0;
  int orders = 0;
  do {
    sum += interpolate_in_order<Dim>(layout, p, t, order);
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  return cubic + near * (sum / orders - cubic);
}

template double interpolate_beside_medial_axis<2>(const Layout<2>&, const double*, const Vec<2>&);
template double interpolate_beside_medial_axis<3>(const Layout<3>&, const double*, const Vec<3>&);

}  // namespace seiche
