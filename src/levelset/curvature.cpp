#include "levelset/curvature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "grid/interpolation.h"

namespace seiche {
namespace {

// All lengths here are in cells. The unit of phi does not matter.

template <int Dim>
Vec<Dim> central_gradient(const Layout<Dim>& layout, const double* f) {
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) g[a] = 0.5 * (f[layout.stride(a)] - f[-layout.stride(a)]);
  return g;
}

// Gradient of the interpolant of phi at x, by central differences over half a cell to each side.
template <int Dim>
Vec<Dim> interpolated_gradient(const Layout<Dim>& layout, const double* f, const Vec<Dim>& x) {
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) {
    const Vec<Dim> half = 0.5 * Vec<Dim>::Unit(a);
    g[a] = interpolate_cubic<Dim>(layout, f, x + half) - interpolate_cubic<Dim>(layout, f, x - half);
  }
  return g;
}

// Orthonormal vectors perpendicular to n.
template <int Dim>
std::array<Vec<Dim>, Dim - 1> tangents(const Vec<Dim>& n) {
  if constexpr (Dim == 2) return {Vec<2>(-n[1], n[0])};
  if constexpr (Dim == 3) {
    int least = 0;
    n.cwiseAbs().minCoeff(&least);
    const Vec<3> t = n.cross(Vec<3>::Unit(least)).normalized();
    return {t, n.cross(t)};
  }
}

constexpr double farthest = 1.5;  // a neighbouring height beyond this many cells belongs to another piece of surface

// Height over x along the unit vector n at which phi is zero and grows. Secant method; `slope` is an estimate of
// dphi/dn. Empty if there is no such height within `farthest` cells.
template <int Dim>
std::optional<double> height(const Layout<Dim>& layout, const double* f, const Vec<Dim>& x, const Vec<Dim>& n,
                             double slope) {
  const auto value = [&](double s) { return interpolate_cubic<Dim>(layout, f, x + s * n); };
  double s0 = 0, v0 = value(0), s1 = -v0 / slope, rate = slope;
  for (int k = 0; k < 20; ++k) {
    if (!(std::abs(s1) <= farthest)) return {};
    const double v1 = value(s1);
    if (std::abs(s1 - s0) < 1e-14 || v1 == 0) return s1;
    if (v1 != v0) rate = (v1 - v0) / (s1 - s0);
    if (rate < 0.2 * slope) return {};
    s0 = s1;
    v0 = v1;
    s1 -= v1 / rate;
    if (std::abs(s1 - s0) < 1e-13) return s1;
  }
  return {};
}

// Curvature (1/cell) of the surface as a graph over the tangent plane at x, g = grad phi there. Liquid is below.
template <int Dim>
std::optional<double> graph_curvature(const Layout<Dim>& layout, const double* f, const Vec<Dim>& x,
                                      const Vec<Dim>& g) {
  const double slope = g.norm();
  if (!(slope > 0)) return {};
  const Vec<Dim> n = g / slope;
  const auto middle = height<Dim>(layout, f, x, n, slope);
  if (!middle) return {};
  Vec<Dim> p = Vec<Dim>::Zero(), bend = Vec<Dim>::Zero();
  const auto across = tangents<Dim>(n);
  for (int k = 0; k < Dim - 1; ++k) {
    const Vec<Dim>& t = across[std::size_t(k)];
    const auto low = height<Dim>(layout, f, x - t, n, slope), high = height<Dim>(layout, f, x + t, n, slope);
    if (!low || !high) return {};
    p[k] = 0.5 * (*high - *low);
    bend[k] = *high - 2 * *middle + *low;
  }
  // Omits the mixed derivative: its factor is the product of two slopes over the tangent plane, each of order h^2.
  const double one = 1 + p.squaredNorm();
  double sum = 0;
  for (int k = 0; k < Dim - 1; ++k) sum += (one - p[k] * p[k]) * bend[k];
  return -sum / std::pow(one, 1.5);
}

// Index coordinates of a cell's centre.
template <int Dim>
Vec<Dim> coordinates(const Layout<Dim>& layout, Site cell) {
  return layout.index(cell).template cast<double>();
}

}  // namespace

template <int Dim>
double curvature_by_differences(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell) {
  const double* f = phi.data() + cell;
  const Vec<Dim> g = central_gradient<Dim>(layout, f);
  const double norm = g.norm();
  if (norm < 1e-12 * layout.h()) return 0;
  // (|g|^2 tr K - g'K g)/|g|^3, K the second differences.
  double sum = 0;
  for (int a = 0; a < Dim; ++a) {
    const Site d = layout.stride(a);
    sum += (norm * norm - g[a] * g[a]) * (f[d] - 2 * f[0] + f[-d]);
    for (int b = 0; b < a; ++b) {
      const Site e = layout.stride(b);
      sum -= 2 * g[a] * g[b] * 0.25 * (f[d + e] - f[d - e] - f[-d + e] + f[-d - e]);
    }
  }
  return sum / (norm * norm * norm * layout.h());
}

template <int Dim>
SurfaceCurvature curvature_at_crossing(const Layout<Dim>& layout, const CellField<Dim>& phi, int axis, Site face) {
  const Site low = face - layout.stride(axis);
  const double t = phi[low] / (phi[low] - phi[face]), most = (Dim - 1) / layout.h();
  const Vec<Dim> x = coordinates(layout, low) + t * Vec<Dim>::Unit(axis);
  const Vec<Dim> g = interpolated_gradient<Dim>(layout, phi.data(), x);
  if (const auto found = graph_curvature<Dim>(layout, phi.data(), x, g))
    return {std::clamp(*found / layout.h(), -most, most), CurvatureSource::heights};
  const double mean =
      (1 - t) * curvature_by_differences(layout, phi, low) + t * curvature_by_differences(layout, phi, face);
  return {std::clamp(mean, -most, most), CurvatureSource::differences};
}

#define SEICHE_INSTANTIATE(D)                                                               \
  template double curvature_by_differences<D>(const Layout<D>&, const CellField<D>&, Site); \
  template SurfaceCurvature curvature_at_crossing<D>(const Layout<D>&, const CellField<D>&, int, Site);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
