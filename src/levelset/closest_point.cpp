#include "levelset/closest_point.h"

#include "grid/interpolation.h"

namespace seiche {
namespace {

// Derivatives of lagrange_weights.
std::array<double, 4> lagrange_slopes(double t) {
  return {-(3 * t * t - 6 * t + 2) / 6, (3 * t * t - 4 * t - 1) / 2, -(3 * t * t - 2 * t - 2) / 2, (3 * t * t - 1) / 6};
}

template <int Dim>
struct ValueAndGradient {
  double value = 0;
  Vec<Dim> gradient = Vec<Dim>::Zero();
};

// Weights along each axis of the values and of the slopes.
template <int Dim>
struct CubicWeights {
  std::array<std::array<double, 4>, Dim> value, slope;
};

// Sums over the stencil along the axes up to Axis, one axis at a time; `at`: its second point along each of them.
template <int Axis, int Dim>
ValueAndGradient<Dim> contract(const Layout<Dim>& layout, const CubicWeights<Dim>& w, const double* at) {
  ValueAndGradient<Dim> r;
  if constexpr (Axis < 0) {
    r.value = *at;
  } else {
    for (int k = 0; k < 4; ++k) {
      const auto part = contract<Axis - 1>(layout, w, at + (k - 1) * layout.stride(Axis));
      r.value += w.value[Axis][k] * part.value;
      for (int b = 0; b < Axis; ++b) r.gradient[b] += w.value[Axis][k] * part.gradient[b];
      r.gradient[Axis] += w.slope[Axis][k] * part.value;
    }
  }
  return r;
}

// Value and gradient of the cubic interpolant at index coordinates x.
template <int Dim>
ValueAndGradient<Dim> interpolate(const Layout<Dim>& layout, const double* f, const Vec<Dim>& x) {
  Vec<Dim> t;
  const Site base = detail::base_site<Dim>(layout, x, 1, 2, t);
  CubicWeights<Dim> w;
  for (int a = 0; a < Dim; ++a) w.value[a] = lagrange_weights(t[a]), w.slope[a] = lagrange_slopes(t[a]);
  return contract<Dim - 1>(layout, w, f + base);
}

// True if the interpolant at x does not read phi across a medial axis. Tests the second differences at the inner points
// of its stencil. On a sphere of R cells they are (1 - n_a^2)/R. Across the medial axis of two parallel surfaces of
// normal n they add up to 2 |n_a|.
template <int Dim>
bool is_smooth_around(const Layout<Dim>& layout, const double* f, const Vec<Dim>& x) {
  constexpr double most = 0.3;
  Vec<Dim> t;
  const Site base = detail::base_site<Dim>(layout, x, 1, 2, t);
  for (unsigned n = 0; n < 1u << (2 * Dim); ++n) {
    Site at = base;
    for (int a = 0; a < Dim; ++a) at += (int(n >> (2 * a) & 3u) - 1) * layout.stride(a);
    for (int a = 0; a < Dim; ++a) {
      const unsigned k = n >> (2 * a) & 3u;
      const Site d = layout.stride(a);
      if ((k == 1 || k == 2) && !(std::abs(f[at + d] - 2 * f[at] + f[at - d]) < most)) return false;
    }
  }
  return true;
}

}  // namespace

template <int Dim>
std::optional<Foot> foot_on_zero(const Layout<Dim>& layout, const CellField<Dim>& phi, const IVec<Dim>& cell,
                                 double reach) {
  constexpr int most_steps = 30;
  constexpr double least_slope = 0.5, largest_slope = 2;    // |grad phi| outside this range: not a distance
  constexpr double on_zero = 1e-12, straight_below = 1e-6;  // cells; the latter's effect on distance is quadratic
  const Vec<Dim> x = cell.template cast<double>();
  Vec<Dim> y = x;
  for (int n = 0; n < most_steps; ++n) {
    const auto [value, g] = interpolate<Dim>(layout, phi.data(), y);
    const double slope = g.norm();
    if (!(slope > least_slope && slope < largest_slope)) return {};
    const Vec<Dim> normal = g / slope, away = x - y;
    const double off = value / slope, height = away.dot(normal);
    const Vec<Dim> across = away - height * normal;
    if (std::abs(off) < on_zero && across.norm() < straight_below) {
      const double sign = phi[layout.site(cell)] < 0 ? -1 : 1;
      if (height * sign < 0 || !is_smooth_around<Dim>(layout, phi.data(), y)) return {};
      return Foot{height, slope};
    }
    y += across - off * normal;
    if (!((y - x).cwiseAbs().maxCoeff() < reach)) return {};
  }
  return {};
}

template std::optional<Foot> foot_on_zero<2>(const Layout<2>&, const CellField<2>&, const IVec<2>&, double);
template std::optional<Foot> foot_on_zero<3>(const Layout<3>&, const CellField<3>&, const IVec<3>&, double);

}  // namespace seiche
