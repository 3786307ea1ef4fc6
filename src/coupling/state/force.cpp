#include "coupling/state/force.h"

#include <algorithm>
#include <cmath>

#include "base/name_pattern.h"

namespace seiche {

template <int Dim>
Force<Dim>::Force(const ForceSpec& from, const ShapeOptions& options)
    : spec(from),
      acceleration(from.acceleration),
      velocity(from.velocity),
      force(from.force),
      strength(from.strength),
      rate(from.rate),
      torque(from.torque),
      region(from.region ? make_shape<Dim>(*from.region, options) : nullptr) {
  if (acceleration.is_constant()) steady = acceleration(Vec3::Zero(), 0);
}

template <int Dim>
bool Force<Dim>::acts_on_solid(const std::string& name) const {
  if (spec.kind != ForceKind::load && spec.acts_on == ForceTarget::liquid) return false;
  return spec.solids.empty() || fits_any(name, spec.solids);
}

template <int Dim>
Vec3 Force<Dim>::field_at(const Vec3& x, double t) const {
  if (spec.kind == ForceKind::acceleration) return steady ? *steady : acceleration(x, t);
  const double s = strength(Vec3::Zero(), t), R = spec.radius;
  const Vec3 way = spec.center - x;
  if (spec.kind == ForceKind::point) return s * R * R * way / std::pow(R * R + way.squaredNorm(), 1.5);
  const Vec3 axis = spec.axis.normalized(), arm = -way + axis.dot(way) * axis;
  return 2 * s / R * axis.cross(arm) / (1 + arm.squaredNorm() / (R * R));
}

namespace {

// Largest |a| of a formula on a regular set of points, m/s^2.
template <int Dim>
double largest_sample(const Force<Dim>& force, const Geometry<Dim>& grid, double t) {
  constexpr int points = 17;
  double largest = 0;
  for (int n = 0; n < (Dim == 2 ? points * points : points * points * points); ++n) {
    Vec<Dim> x;
    for (int a = 0, rest = n; a < Dim; ++a, rest /= points)
      x[a] = grid.lower[a] + grid.h * grid.cells[a] * (rest % points) / (points - 1);
    const double size = force.field_at(extend<Dim>(x), t).norm();
    if (std::isfinite(size)) largest = std::max(largest, size);
  }
  return largest;
}

template <int Dim>
double largest_of(const Force<Dim>& force, const Geometry<Dim>& grid, double t) {
  constexpr double most_of_point = 0.385;  // max of z/(1 + z^2)^(3/2), at z^2 = 1/2
  if (force.steady && force.spec.kind == ForceKind::acceleration) return force.steady->norm();
  if (force.spec.kind == ForceKind::acceleration) return largest_sample(force, grid, t);
  return (force.spec.kind == ForceKind::point ? most_of_point : 1) * std::abs(force.strength(Vec3::Zero(), t));
}

}  // namespace

template <int Dim>
double largest_field(const std::vector<Force<Dim>>& forces, const Geometry<Dim>& grid, double t0, double t1) {
  double sum = 0;
  for (const Force<Dim>& force : forces) {
    if (!force.is_field()) continue;
    double largest = 0;
    for (const double t : {t0, 0.5 * (t0 + t1), t1}) largest = std::max(largest, largest_of(force, grid, t));
    sum += largest;
  }
  return sum;
}

template struct Force<2>;
template struct Force<3>;
template double largest_field<2>(const std::vector<Force<2>>&, const Geometry<2>&, double, double);
template double largest_field<3>(const std::vector<Force<3>>&, const Geometry<3>&, double, double);

}  // namespace seiche
