#include "geometry/mesh/clipped_volume.h"

#include <array>

namespace seiche {
namespace {

using Polygon = std::vector<Vec3>;

// The part of a polygon with sign x_axis <= sign level (Sutherland, Hodgman 1974).
Polygon clip(const Polygon& polygon, int axis, double level, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a[axis] - level), db = sign * (b[axis] - level);
    if (da <= 0) kept.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + da / (da - db) * (b - a));
  }
  return kept;
}

// int (x - level) n_x dA over a polygon. n_x dA is its area projected along x.
double flux(const Polygon& p, double level) {
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const Vec3 a = p[i - 1] - p[0], b = p[i] - p[0];
    sum += 0.5 * (a[1] * b[2] - a[2] * b[1]) * ((p[0][0] + p[i - 1][0] + p[i][0]) / 3 - level);
  }
  return sum;
}

// The same for a segment with the inside to its left: n_x ds = dy.
double flux_of_segment(const Vec3& a, const Vec3& b, double level) {
  return (b[1] - a[1]) * (0.5 * (a[0] + b[0]) - level);
}

// Clips the segment's parameter range, because clip() would traverse a polygon of two corners twice.
double clipped_flux(const std::array<Vec3, 2>& segment, const Vec3& lower, const Vec3& upper, double level) {
  std::array<double, 2> range{0, 1};
  const Vec3 d = segment[1] - segment[0];
  const auto cut = [&](double start, double slope) {  // start + slope s <= 0
    if (slope == 0 && start > 0) range = {1, 0};
    if (slope > 0) range[1] = std::min(range[1], -start / slope);
    if (slope < 0) range[0] = std::max(range[0], -start / slope);
  };
  cut(segment[0][0] - level, d[0]);
  cut(segment[0][1] - upper[1], d[1]);
  cut(lower[1] - segment[0][1], -d[1]);
  if (range[0] >= range[1]) return 0;
  return flux_of_segment(segment[0] + range[0] * d, segment[0] + range[1] * d, level);
}

// Volume of the part with x <= level between the box's other sides, by the divergence theorem with the field (x -
// level) e_x. The field is zero on the cap at x = level and tangential to the caps at the other sides.
template <int Dim>
double volume_below(const SurfaceMesh& s, const Vec3& lower, const Vec3& upper, double level) {
  double sum = 0;
  if constexpr (Dim == 2) {
    for (const auto& [a, b] : s.segments)
      sum += clipped_flux({s.points[std::size_t(a)], s.points[std::size_t(b)]}, lower, upper, level);
    return sum;
  }
  for (const auto& t : s.triangles) {
    Polygon p =
        clip({s.points[std::size_t(t[0])], s.points[std::size_t(t[1])], s.points[std::size_t(t[2])]}, 0, level, 1);
    for (int a = 1; a < Dim && !p.empty(); ++a) p = clip(clip(p, a, upper[a], 1), a, lower[a], -1);
    sum += flux(p, level);
  }
  return sum;
}

}  // namespace

template <int Dim>
double clipped_volume(const SurfaceMesh& surface, const Vec3& lower, const Vec3& upper) {
  return volume_below<Dim>(surface, lower, upper, upper[0]) - volume_below<Dim>(surface, lower, upper, lower[0]);
}

template double clipped_volume<2>(const SurfaceMesh&, const Vec3&, const Vec3&);
template double clipped_volume<3>(const SurfaceMesh&, const Vec3&, const Vec3&);

}  // namespace seiche
