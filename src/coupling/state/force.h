#pragma once
// A [[force]] with its formulas, as the simulation uses it.
#include <memory>
#include <optional>

#include "base/expression.h"
#include "base/force_spec.h"
#include "geometry/shapes/shapes.h"
#include "grid/layout.h"

namespace seiche {

// Formulas are evaluated in order: two threads must not use one force at once.
template <int Dim>
struct Force {
  ForceSpec spec;
  VectorExpression acceleration, velocity, force;
  Expression strength, rate, torque;
  std::unique_ptr<ShapeField<Dim>> region;  // null: everywhere
  std::optional<Vec3> steady{};             // acceleration, if no variable occurs in it: formulas cost much

  Force(const ForceSpec& from, const ShapeOptions& options);

  bool acts_on_liquid() const { return spec.kind != ForceKind::load && spec.acts_on != ForceTarget::solids; }
  bool acts_on_solid(const std::string& name) const;
  bool acts_at(const Vec3& x) const { return !region || (*region)(truncate<Dim>(x)) < 0; }
  // True for kinds that accelerate whatever is at x alike.
  bool is_field() const {
    return spec.kind == ForceKind::acceleration || spec.kind == ForceKind::point || spec.kind == ForceKind::vortex;
  }
  // m/s^2, of fields, at x (m) and t (s), wherever the region is:
  //   point   s R^2 d/(R^2 + |d|^2)^(3/2),  d the way to the centre
  //   vortex  2 s (r/R)/(1 + (r/R)^2) round the axis at the distance r, as of a Lamb vortex that has spread
  Vec3 field_at(const Vec3& x, double t) const;
};

// Bound (m/s^2) of the accelerations that fields give between t0 and t1 (s): exact for points and vortices, of formulas
// the largest of 17^Dim points of the domain at three times.
template <int Dim>
double largest_field(const std::vector<Force<Dim>>& forces, const Geometry<Dim>& grid, double t0, double t1);

// Acceleration (m/s^2) of liquid at x by gravity and the fields of time t (s).
template <int Dim>
Vec3 pull_on_liquid(Vec3 gravity, const std::vector<Force<Dim>>& forces, const Vec3& x, double t) {
  for (const Force<Dim>& force : forces)
    if (force.is_field() && force.acts_on_liquid() && force.acts_at(x)) gravity += force.field_at(x, t);
  return gravity;
}

}  // namespace seiche
