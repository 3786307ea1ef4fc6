#pragma once
// A solid of a scene: static, moved as prescribed, or moved by forces; elastic ones change their shape, too.
#include <memory>
#include <optional>

#include <Eigen/Geometry>

#include "base/expression.h"
#include "geometry/shapes/shapes.h"
#include "solid/body/mass_properties.h"
#include "solid/elastic/solid.h"

namespace seiche {

// x = rotation (X - pivot) + pivot + displacement, X the rest position.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 pivot{0, 0, 0}, displacement{0, 0, 0};
  Vec3 apply(const Vec3& rest) const { return rotation * (rest - pivot) + pivot + displacement; }
  Vec3 to_rest(const Vec3& x) const { return rotation.transpose() * (x - pivot - displacement) + pivot; }
};

// Rigid velocity field v(x) = linear + angular x (x - about): free of divergence, also as sampled on a grid.
struct Twist {
  Vec3 linear{0, 0, 0}, angular{0, 0, 0}, about{0, 0, 0};
  Vec3 at(const Vec3& x) const { return linear + angular.cross(x - about); }
  bool at_rest() const { return linear.isZero(0) && angular.isZero(0); }
};

template <int Dim>
class ThinSurface;

template <int Dim>
class Body {
 public:
  // lower and upper: the corners of the domain.
  Body(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper);

  const SolidSpec& spec() const { return spec_; }
  const SolidKind& kind() const { return spec_.kind; }
  const ElasticSolid<Dim>* elements() const { return elastic_.get(); }  // null: it does not deform
  const ElasticSolid<Dim>& elastic() const { return *elastic_; }        // where it has elements
  const MassProperties& mass() const { return mass_; }                  // at rest; zero unless forces move it
  const SurfaceMesh& contact_surface() const { return surface_; }       // in the rest pose
  double radius() const { return radius_; }  // about its centre of mass where forces move it as a whole, m; else 0
  // Whether a grid can miss it (solid/body/thinness.h).
  bool is_thin() const { return thin_; }
  // Of a thin body in this pose that does not deform: whether the segment from x to y meets its surface.
  bool lies_between(const Pose& pose, const Vec<Dim>& x, const Vec<Dim>& y) const;
  // As prescribed.
  Pose pose(double t) const;
  // The rigid motion that takes the body from its pose at t0 to that at t1 in t1 - t0.
  Twist twist(double t0, double t1) const;
  // Velocity at time t from the motion at t and up to 2 tau later: -3/2, 2, -1/2 (second order, one-sided, since a
  // motion need not be defined before the start).
  Twist velocity(double t, double tau) const;
  // Signed distance, negative inside (m); of one that does not deform.
  double distance_at_rest(const Vec<Dim>& x) const { return (*shape_)(x); }
  double distance_in(const Pose& pose, const Vec<Dim>& x) const;
  // The point that solids.csv reports and torques are taken about, at rest: the centre of mass, of the hole where the
  // solid is the outside of a shape, the point of a plane.
  const Vec3& reference_point() const { return reference_; }

 private:
  struct Motion {
    VectorExpression translate;
    Expression degrees;
    Vec3 axis, center;
  };
  void make_elastic(const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper);

  SolidSpec spec_;
  std::unique_ptr<ShapeField<Dim>> shape_;
  std::unique_ptr<ElasticSolid<Dim>> elastic_;
  std::optional<Motion> motion_;
  MassProperties mass_;
  SurfaceMesh surface_;
  Vec3 reference_{0, 0, 0};
  double radius_ = 0;
  bool thin_ = false;
  std::shared_ptr<const ThinSurface<Dim>> thin_surface_;  // of a thin one that is not elastic
};

}  // namespace seiche
