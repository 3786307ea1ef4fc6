#include "geometry/mesh/exact_orientation.h"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace seiche {
namespace {

// An unevaluated sum of non-overlapping doubles in ascending order of magnitude (Shewchuk 1997). It is exact without
// over- and underflow. The last term has the sign of the sum.
using Expansion = std::vector<double>;

struct Parts {
  double sum, error;
};

Parts two_sum(double a, double b) {
  const double sum = a + b, from_b = sum - a, from_a = sum - from_b;
  return {sum, (a - from_a) + (b - from_b)};
}

// e + b
Expansion grown(const Expansion& e, double b) {
  Expansion result;
  for (const double part : e) {
    const Parts p = two_sum(b, part);
    if (p.error != 0) result.push_back(p.error);
    b = p.sum;
  }
  if (b != 0) result.push_back(b);
  return result;
}

Expansion operator+(Expansion e, const Expansion& f) {
  for (const double part : f) e = grown(e, part);
  return e;
}

Expansion operator*(const Expansion& e, const Expansion& f) {
  Expansion result;
  for (const double a : e)
    for (const double b : f) {
      const double product = a * b;
      result = grown(grown(result, std::fma(a, b, -product)), product);
    }
  return result;
}

Expansion operator-(const Expansion& e, const Expansion& f) {
  return e + Expansion{-1} * f;
}

Expansion difference(double a, double b) {
  return grown(grown({}, a), -b);
}

int sign(double x) {
  return (x > 0) - (x < 0);
}

int sign(const Expansion& e) {
  return e.empty() ? 0 : sign(e.back());
}

using Column = std::array<Expansion, 3>;

Column difference(const Vec3& a, const Vec3& b) {
  return {difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2])};
}

// Round-off bounds of the determinants below, relative to the sum of the magnitudes of their products (Shewchuk 1997:
// 3.3e-16 and 7.8e-16).
constexpr double error_in_plane = 4e-16, error_in_space = 1e-15;

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  const double one = (b[i] - a[i]) * (c[j] - a[j]), two = (b[j] - a[j]) * (c[i] - a[i]);
  if (std::abs(one - two) > error_in_plane * (std::abs(one) + std::abs(two))) return sign(one - two);
  const Column u = difference(b, a), v = difference(c, a);
  return sign(u[i] * v[j] - u[j] * v[i]);
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const Vec3 size = u.cwiseAbs(), other = v.cwiseAbs(), third = w.cwiseAbs();
  const double det = u.cross(v).dot(w);
  const double scale = third[0] * (size[1] * other[2] + size[2] * other[1]) +
                       third[1] * (size[2] * other[0] + size[0] * other[2]) +
                       third[2] * (size[0] * other[1] + size[1] * other[0]);
  if (std::abs(det) > error_in_space * scale) return sign(det);
  for (int k = 0; k < 3; ++k)
    if (u[k] == 0 && v[k] == 0 && w[k] == 0) return 0;  // coplanar across an axis; differences of equals are exact
  const Column U = difference(b, a), V = difference(c, a), W = difference(d, a);
  return sign(W[0] * (U[1] * V[2] - U[2] * V[1]) + W[1] * (U[2] * V[0] - U[0] * V[2]) +
              W[2] * (U[0] * V[1] - U[1] * V[0]));
}

}  // namespace seiche
