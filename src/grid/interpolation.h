#pragma once
// Tensor-product interpolation of fields at points given in index coordinates g = (x - lower)/h - offset. Points whose
// stencil would leave the padded box are moved to the nearest point whose stencil is inside.
#include <cmath>

#include "grid/layout.h"

namespace seiche {

// Four-point Lagrange weights at fraction t in [0, 1) between the second and the third point.
inline std::array<double, 4> lagrange_weights(double t) {
  const double a = t + 1, c = t - 1, d = t - 2;
  return {-t * c * d / 6, a * c * d / 2, -a * t * d / 2, a * t * c / 6};
}

namespace detail {

// Splits g into base site and fraction t. The stencil has `low` points below and `high` points above the base.
template <int Dim>
Site base_site(const Layout<Dim>& layout, const Vec<Dim>& g, int low, int high, Vec<Dim>& t) {
  Site s = 0;
  for (int a = 0; a < Dim; ++a) {
    const int first = layout.padded().lower[a] + low, last = layout.padded().upper[a] - 1 - high;
    const double x = std::min(std::max(double(first), g[a]), double(last) + 1);  // `first` if g is NaN
    const int whole = int(x), i = std::min(whole - (x < whole ? 1 : 0), last);   // the floor; std::floor is a call
    t[a] = x - i;
    s += (i - layout.padded().lower[a]) * layout.stride(a);
  }
  return s;
}

}  // namespace detail

// Multilinear, 2^Dim points.
template <int Dim>
double interpolate_linear(const Layout<Dim>& layout, const double* f, const Vec<Dim>& g) {
  Vec<Dim> t;
  const Site s = detail::base_site<Dim>(layout, g, 0, 1, t);
  double sum = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    double w = 1;
    Site at = s;
    for (int a = 0; a < Dim; ++a) {
      const int up = (corner >> a) & 1;
      w *= up ? t[a] : 1 - t[a];
      at += up * layout.stride(a);
    }
    sum += w * f[at];
  }
  return sum;
}

// Tensor product of four-point Lagrange polynomials: fourth order, exact for cubics. Rows along the first axis are
// summed as vectors.
template <int Dim>
double interpolate_cubic(const Layout<Dim>& layout, const double* f, const Vec<Dim>& g) {
  Vec<Dim> t;
  const Site s = detail::base_site<Dim>(layout, g, 1, 2, t);
  std::array<std::array<double, 4>, Dim> w;
  for (int a = 0; a < Dim; ++a) w[a] = lagrange_weights(t[a]);
  using Row = Eigen::Array4d;
  const auto row = [](const double* p) { return Eigen::Map<const Row>(p - 1); };
  const auto plane = [&](const double* p) -> Row {
    const Site d = layout.stride(1);
    return w[1][0] * row(p - d) + w[1][1] * row(p) + w[1][2] * row(p + d) + w[1][3] * row(p + 2 * d);
  };
  Row sum;
  if constexpr (Dim == 2) {
    sum = plane(f + s);
  } else {
    const Site d = layout.stride(2);
    const double* p = f + s;
    sum = w[2][0] * plane(p - d) + w[2][1] * plane(p) + w[2][2] * plane(p + d) + w[2][3] * plane(p + 2 * d);
  }
  return (sum * Eigen::Map<const Row>(w[0].data())).sum();
}

// Six-point Lagrange weights at fraction t in [0, 1) between the third and the fourth point.
inline std::array<double, 6> lagrange_weights_six(double t) {
  const double a = t + 2, b = t + 1, d = t - 1, e = t - 2, f = t - 3;
  return {-b * t * d * e * f / 120, a * t * d * e * f / 24,  -a * b * d * e * f / 12,
          a * b * t * e * f / 12,   -a * b * t * d * f / 24, a * b * t * d * e / 120};
}

namespace detail {

// Weighted sum over the points along axes 0 ... Axis.
template <int Dim, int Axis>
double weigh_six(const Layout<Dim>& layout, const double* p, const std::array<std::array<double, 6>, Dim>& w) {
  const Site d = layout.stride(Axis);
  double sum = 0;
  for (int k = 0; k < 6; ++k) {
    const double* at = p + (k - 2) * d;
    if constexpr (Axis == 0)
      sum += w[Axis][std::size_t(k)] * *at;
    else
      sum += w[Axis][std::size_t(k)] * weigh_six<Dim, Axis - 1>(layout, at, w);
  }
  return sum;
}

}  // namespace detail

// Tensor product of six-point Lagrange polynomials: sixth order, exact for quintics.
template <int Dim>
double interpolate_quintic(const Layout<Dim>& layout, const double* f, const Vec<Dim>& g) {
  Vec<Dim> t;
  const Site s = detail::base_site<Dim>(layout, g, 2, 3, t);
  std::array<std::array<double, 6>, Dim> w;
  for (int a = 0; a < Dim; ++a) w[a] = lagrange_weights_six(t[a]);
  return detail::weigh_six<Dim, Dim - 1>(layout, f + s, w);
}

// Index coordinates of a position for fields of the given offset.
template <int Dim>
Vec<Dim> index_coordinates(const Layout<Dim>& layout, const Vec<Dim>& x, const Vec<Dim>& offset) {
  return (x - layout.geometry().lower) / layout.h() - offset;
}

}  // namespace seiche
