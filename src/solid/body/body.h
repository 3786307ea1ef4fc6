#pragma once
// A solid of a scene: static, prescribed (rigid or deforming), or moved by forces (rigid or elastic).
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

// Rigid velocity field v(x) = linear + angular x (x - about). It has no divergence, also when sampled on a grid.
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
  // lower and upper: corners of the domain.
  Body(const SolidSpec& spec, const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper);

  const SolidSpec& spec() const { return spec_; }
  const SolidKind& kind() const { return spec_.kind; }
  bool moves() const { return spec_.kind.moves(); }
  bool is_prescribed() const { return spec_.kind.is_prescribed(); }
  bool is_free() const { return spec_.kind.is_free(); }            // forces move it: it has mass and unknowns
  bool deforms() const { return elastic_ != nullptr; }             // its surface follows nodes, not a pose
  const ElasticSolid<Dim>& elastic() const { return *elastic_; }   // of a solid that deforms only
  const MassProperties& mass() const { return mass_; }             // at rest; no mass unless forces move it
  const SurfaceMesh& contact_surface() const { return surface_; }  // in the rest pose
  // Volume of a sphere, cylinder or capsule, or of a solid that forces move, over that within its surface, whose facets
  // cut a little off round shapes. 1 for others.
  double facet_ratio() const { return facet_ratio_; }
  double radius() const { return radius_; }  // of a rigid body about its centre of mass, m; 0 for other solids
  // True if a grid can miss the solid (solid/body/thinness.h).
  bool is_thin() const { return thin_; }
  // True if the segment from x to y crosses the surface. For thin solids that do not deform, in the given pose.
  bool lies_between(const Pose& pose, const Vec<Dim>& x, const Vec<Dim>& y) const;
  // Prescribed pose at time t (s).
  Pose pose(double t) const;
  // Rigid motion from the pose at t0 to the pose at t1, as a constant velocity over t1 - t0.
  Twist twist(double t0, double t1) const;
  // Velocity at time t by the second-order one-sided difference -3/2, 2, -1/2 over t, t + tau, t + 2 tau. It looks
  // forward only, since a motion need not be defined before the start.
  Twist velocity(double t, double tau) const;
  // Signed distance (m), negative inside. For solids that do not deform.
  double distance_at_rest(const Vec<Dim>& x) const { return (*shape_)(x); }
  double distance_in(const Pose& pose, const Vec<Dim>& x) const;
  // Point at rest that solids.csv reports and torques refer to: the centre of mass. For the outside of a shape, the
  // centre of the hole; for a plane, its point.
  const Vec3& reference_point() const { return reference_; }

 private:
  struct Motion {
    VectorExpression translate;
    Expression degrees;
    Vec3 axis, center;
  };
  void make_elastic(const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper);
  void make_deforming(const ShapeOptions& options, const Vec<Dim>& lower, const Vec<Dim>& upper);

  SolidSpec spec_;
  std::unique_ptr<ShapeField<Dim>> shape_;
  std::unique_ptr<ElasticSolid<Dim>> elastic_;
  std::optional<Motion> motion_;
  MassProperties mass_;
  SurfaceMesh surface_;
  Vec3 reference_{0, 0, 0};
  double radius_ = 0, facet_ratio_ = 1;
  bool thin_ = false;
  std::shared_ptr<const ThinSurface<Dim>> thin_surface_;  // of a thin solid that is not elastic
};

}  // namespace seiche
