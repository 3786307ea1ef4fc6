#include "solid/rigid/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace seiche {
namespace {

using Quaternion = Eigen::Quaterniond;

constexpr double longest_split = 0.05;  // rad per step of the splitting: relative error of the energy about 1e-4
constexpr double most_splits = 10000;   // limits the time of one call for absurdly long steps

// q = (cos |w|/2, sin |w|/2 w/|w|); the sine's series near zero.
Quaternion exp_quaternion(const Vec3& w) {
  const double half = w.norm() / 2;
  const double sinc = half > 1e-4 ? std::sin(half) / half : 1 - half * half / 6;  // next term: 1e-18
  Quaternion q;
  q.w() = std::cos(half);
  q.vec() = sinc / 2 * w;
  return q;
}

// w = 2 atan2(|v|, q0) v/|v|, well conditioned from 0 to pi.
Vec3 log_quaternion(const Quaternion& q) {
  const double sign = q.w() < 0 ? -1 : 1, length = q.vec().norm();
  if (length == 0) return Vec3::Zero();
  return sign * 2 * std::atan2(length, sign * q.w()) / length * q.vec();
}

// Splitting of free rotation into flows that are rotations. With moments a <= b <= c and body-frame angular momentum m,
//   H = |l|^2/(2b) + (1/a - 1/b) m_a^2/2 + (1/c - 1/b) m_c^2/2.
// The first part rotates the body about l and commutes with the others. These rotate it about its first and last axis
// (Hairer, Lubich, Wanner, Geometric Numerical Integration, VII.5; Touma, Wisdom 1994).
struct Splitting {
  double middle, first, last;  // 1/b, 1/a - 1/b, 1/c - 1/b

  explicit Splitting(const Vec3& inverse) : middle(inverse[1]), first(inverse[0] - middle), last(inverse[2] - middle) {}

  // All moments are equal up to round-off: the first part is the whole motion.
  bool is_even() const { return std::max(std::abs(first), std::abs(last)) <= 1e-14 * middle; }
  // Cube root of Strang's local error, dt^3 |[X, [X, Y]]|. Zero if either part vanishes; one step is then exact.
  double angle(double l, double dt) const {
    const double a = std::abs(first) * l * dt, c = std::abs(last) * l * dt;
    return std::cbrt(a * c * std::max(a, c));
  }
};

// Rotation since the start of a free motion (world axes), and the sum of its small rotation vectors.
struct Turn {
  Quaternion rotation = Quaternion::Identity();
  Vec3 sum{0, 0, 0};

  void add(const Vec3& w) {
    sum += w;
    rotation = (exp_quaternion(w) * rotation).normalized();
  }
  // Rotates about principal axis e = rotation `axis_at_start` by the angle (e . l) rate dt.
  void add_about(const Vec3& axis_at_start, double rate, const Vec3& l, double dt) {
    const Vec3 e = rotation * axis_at_start;
    add(e.dot(l) * rate * dt * e);
  }
};

// Rotation vector nearest to the sum of the parts, so that whole turns count.
Vec3 unwind(const Turn& turn) {
  const Vec3 w = log_quaternion(turn.rotation);
  const double circle = 2 * std::numbers::pi;
  const Vec3 axis = (w.norm() > 1e-8 ? w : turn.sum).stableNormalized();  // near a whole turn w has no direction
  return w + std::round((turn.sum - w).dot(axis) / circle) * circle * axis;
}

}  // namespace

Eigen::Matrix3d exp_rotation(const Vec3& w) {
  return exp_quaternion(w).normalized().toRotationMatrix();
}

Vec3 log_rotation(const Eigen::Matrix3d& r) {
  return log_quaternion(Quaternion(r).normalized());
}

Vec3 PrincipalInertia::inverse_moments() const {
  Vec3 inverse = Vec3::Zero();
  for (int a = 0; a < 3; ++a) {
    if (moments[a] > thinnest_moment * moments[2]) inverse[a] = 1 / moments[a];
  }
  return inverse;
}

namespace {

bool is_diagonal(const Eigen::Matrix3d& m) {
  return m(0, 1) == 0 && m(0, 2) == 0 && m(1, 2) == 0;
}

// The axes of space, by ascending moments.
PrincipalInertia sorted_axes(const Vec3& moments) {
  std::array<int, 3> order{0, 1, 2};
  // By hand: std::stable_sort takes memory.
  for (const std::size_t n : {0, 1, 0})
    if (moments[order[n + 1]] < moments[order[n]]) std::swap(order[n], order[n + 1]);
  PrincipalInertia result;
  for (int a = 0; a < 3; ++a) {
    result.axes.col(a) = Vec3::Unit(order[std::size_t(a)]);
    result.moments[a] = std::max(0.0, moments[order[std::size_t(a)]]);
  }
  return result;
}

PrincipalInertia eigen_axes(const Eigen::Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  return {solver.eigenvectors(), solver.eigenvalues().cwiseMax(0.0)};
}

}  // namespace

PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia) {
  PrincipalInertia result = is_diagonal(inertia) ? sorted_axes(inertia.diagonal()) : eigen_axes(inertia);
  if (result.axes.determinant() < 0) result.axes.col(0) *= -1;
  return result;
}

Vec3 angular_velocity(const PrincipalInertia& inertia, const Eigen::Matrix3d& r, const Vec3& l) {
  const Eigen::Matrix3d q = r * inertia.axes;
  return q * inertia.inverse_moments().cwiseProduct(q.transpose() * l);
}

FreeRotation rotate_freely(const PrincipalInertia& inertia, const Eigen::Matrix3d& r, const Vec3& l, double dt) {
  if (dt == 0) return {r, angular_velocity(inertia, r, l)};
  const Splitting split(inertia.inverse_moments());
  if (split.is_even()) return {exp_rotation(dt * split.middle * l) * r, split.middle * l};
  const double steps = std::clamp(std::ceil(split.angle(l.norm(), std::abs(dt)) / longest_split), 1.0, most_splits);
  const double step = dt / steps;
  const Vec3 first = r * inertia.axes.col(0), last = r * inertia.axes.col(2);
  Turn turn;
  for (int i = 0; i < int(steps); ++i) {
    turn.add_about(first, split.first, l, step / 2);
    turn.add_about(last, split.last, l, step);
    turn.add_about(first, split.first, l, step / 2);
  }
  turn.add(dt * split.middle * l);
  const Quaternion end = turn.rotation * Quaternion(r);
  return {end.normalized().toRotationMatrix(), unwind(turn) / dt};
}

}  // namespace seiche
