#include "geometry/mesh/segment_crossing.h"

#include <Eigen/Geometry>

namespace seiche {
namespace {

bool within(double share) {
  return share >= -crossing_slack && share <= 1 + crossing_slack;
}

double cross(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

}  // namespace

// p + s (q - p) = a + t (b - a)
template <>
std::optional<double> crossing<2>(const Vec<2>& p, const Vec<2>& q, const std::array<Vec<2>, 2>& facet) {
  const Vec<2> d = q - p, e = facet[1] - facet[0], from = facet[0] - p;
  const double det = cross(d, e);
  if (std::abs(det) <= crossing_slack * d.norm() * e.norm()) return {};
  const double s = cross(from, e) / det;
  if (!within(s) || !within(cross(from, d) / det)) return {};
  return s;
}

// p + s (q - p) = a + u (b - a) + v (c - a) (Moeller, Trumbore 1997)
template <>
std::optional<double> crossing<3>(const Vec<3>& p, const Vec<3>& q, const std::array<Vec<3>, 3>& facet) {
  const Vec<3> d = q - p, e = facet[1] - facet[0], f = facet[2] - facet[0], n = e.cross(f), from = p - facet[0];
  const double det = -d.dot(n);
  if (std::abs(det) <= crossing_slack * d.norm() * n.norm()) return {};
  const Vec<3> m = from.cross(d);
  const double s = from.dot(n) / det, u = f.dot(m) / det, v = -e.dot(m) / det;
  if (!within(s) || !within(u) || !within(v) || !within(u + v)) return {};
  return s;
}

}  // namespace seiche
