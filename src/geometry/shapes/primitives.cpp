// Exact signed distances of the primitive shapes, in 2D and 3D from one source.
#include <algorithm>
#include <cmath>

#include "geometry/shapes/makers.h"

namespace seiche::shape {
namespace {

// Signed distance from the box {q <= 0}. q: signed distances beyond its faces, one per axis.
template <int N>
double distance_of_excess(const Vec<N>& q) {
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

template <int Dim>
struct Box : ShapeField<Dim> {
  Vec<Dim> lower, upper;
  double operator()(const Vec<Dim>& x) const override {
    const Vec<Dim> q = (lower - x).cwiseMax(x - upper);
    return distance_of_excess<Dim>(q);
  }
};

template <int Dim>
struct Sphere : ShapeField<Dim> {
  Vec<Dim> center;
  double radius = 0;
  double operator()(const Vec<Dim>& x) const override { return (x - center).norm() - radius; }
};

// All points within `radius` of the axis, cut off flat at both ends; in 2D a rectangle of width 2 radius.
template <int Dim>
struct Cylinder : ShapeField<Dim> {
  Vec<Dim> from, axis;  // axis has unit length
  double length = 0, radius = 0;
  double operator()(const Vec<Dim>& x) const override {
    const double along = axis.dot(x - from);
    const double across = (x - from - along * axis).norm();
    return distance_of_excess<2>({std::max(-along, along - length), across - radius});
  }
};

template <int Dim>
struct Capsule : ShapeField<Dim> {
  Vec<Dim> from, span;
  double radius = 0;
  double operator()(const Vec<Dim>& x) const override {
    const double squared = span.squaredNorm();
    const double share = squared > 0 ? std::clamp(span.dot(x - from) / squared, 0.0, 1.0) : 0.0;
    return (x - from - share * span).norm() - radius;
  }
};

template <int Dim>
struct Plane : ShapeField<Dim> {
  Vec<Dim> point, normal;  // normal has unit length
  double operator()(const Vec<Dim>& x) const override { return normal.dot(x - point); }
};

void require_radius(const ShapeSpec& spec) {
  if (!(spec.radius > 0) || !std::isfinite(spec.radius)) {
    refuse("radius of the " + spec.kind + " is not positive; give a length in m");
  }
}

void require_finite(const ShapeSpec& spec, const Vec3& one, const Vec3& other) {
  if (!one.allFinite() || !other.allFinite()) refuse("the " + spec.kind + " has a coordinate that is not finite");
}

}  // namespace

template <int Dim>
Field<Dim> make_box(const ShapeSpec& spec, const ShapeOptions&) {
  require_finite(spec, spec.lower, spec.upper);
  auto box = std::make_unique<Box<Dim>>();
  box->lower = truncate<Dim>(spec.lower);
  box->upper = truncate<Dim>(spec.upper);
  if (!(box->lower.array() < box->upper.array()).all()) {
    refuse("the box is empty; each component of lower must be less than that of upper");
  }
  return box;
}

template <int Dim>
Field<Dim> make_sphere(const ShapeSpec& spec, const ShapeOptions&) {
  require_radius(spec);
  require_finite(spec, spec.center, spec.center);
  auto sphere = std::make_unique<Sphere<Dim>>();
  sphere->center = truncate<Dim>(spec.center);
  sphere->radius = spec.radius;
  return sphere;
}

template <int Dim>
Field<Dim> make_cylinder(const ShapeSpec& spec, const ShapeOptions&) {
  require_radius(spec);
  require_finite(spec, spec.from, spec.to);
  auto cylinder = std::make_unique<Cylinder<Dim>>();
  const Vec<Dim> span = truncate<Dim>(Vec3(spec.to - spec.from));
  cylinder->from = truncate<Dim>(spec.from);
  cylinder->length = span.norm();
  cylinder->radius = spec.radius;
  if (!(cylinder->length > 0)) refuse("the cylinder has no length; its from and to must differ");
  cylinder->axis = span / cylinder->length;
  return cylinder;
}

template <int Dim>
Field<Dim> make_capsule(const ShapeSpec& spec, const ShapeOptions&) {
  require_radius(spec);
  require_finite(spec, spec.from, spec.to);
  auto capsule = std::make_unique<Capsule<Dim>>();
  capsule->from = truncate<Dim>(spec.from);
  capsule->span = truncate<Dim>(Vec3(spec.to - spec.from));
  capsule->radius = spec.radius;
  return capsule;
}

template <int Dim>
Field<Dim> make_plane(const ShapeSpec& spec, const ShapeOptions&) {
  require_finite(spec, spec.point, spec.normal);
  auto plane = std::make_unique<Plane<Dim>>();
  plane->point = truncate<Dim>(spec.point);
  plane->normal = truncate<Dim>(spec.normal);
  const double length = plane->normal.stableNorm();
  if (!(length > 0)) refuse("the normal of the plane is zero; it must point out of the shape");
  plane->normal /= length;
  return plane;
}

#define SEICHE_INSTANTIATE(make)                                         \
  template Field<2> make<2>(const ShapeSpec& spec, const ShapeOptions&); \
  template Field<3> make<3>(const ShapeSpec& spec, const ShapeOptions&);
SEICHE_INSTANTIATE(make_box)
SEICHE_INSTANTIATE(make_sphere)
SEICHE_INSTANTIATE(make_cylinder)
SEICHE_INSTANTIATE(make_capsule)
SEICHE_INSTANTIATE(make_plane)
#undef SEICHE_INSTANTIATE

}  // namespace seiche::shape
