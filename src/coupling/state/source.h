#pragma once
// A region that a source keeps filled with liquid for a time, or a drain empty, or in which one of them feeds a flow.
#include <memory>

#include <Eigen/Geometry>

#include "base/expression.h"
#include "base/fluid_spec.h"
#include "coupling/geometry/placed_solid.h"
#include "geometry/shapes/shapes.h"

namespace seiche {

// A source's own motion.
struct SourceMotion {
  VectorExpression translate;
  Expression degrees;
  Vec3 axis, center;

  explicit SourceMotion(const MotionSpec& spec)
      : translate(spec.translate), degrees(spec.degrees), axis(spec.axis.normalized()), center(spec.center) {}
  Pose pose(double t) const {
    const double angle = degrees(Vec3::Zero(), t) * M_PI / 180;
    return {Eigen::AngleAxisd(angle, axis).toRotationMatrix(), center, translate(Vec3::Zero(), t)};
  }
  // Velocity at t, by differences over tau (s) to both sides, before the start to one.
  Twist twist(double t, double tau) const {
    const double t0 = std::max(t - tau, 0.0), span = t + tau - t0;
    const Vec3 d0 = translate(Vec3::Zero(), t0), d1 = translate(Vec3::Zero(), t + tau);
    const double turn = degrees(Vec3::Zero(), t + tau) - degrees(Vec3::Zero(), t0);
    return {(d1 - d0) / span, axis * (turn * M_PI / 180 / span), center + translate(Vec3::Zero(), t)};
  }
};

// A value: copies share what does not change, and are placed one by one.
template <int Dim>
struct Source {
  LiquidSourceSpec spec;
  std::string name;  // "liquid.source.0"
  double sign;       // 1: adds liquid, -1: takes it away
  std::shared_ptr<const ShapeField<Dim>> shape;
  std::shared_ptr<const VectorExpression> flow;     // of the liquid that is added, m/s, at rest
  std::shared_ptr<const Expression> rate = {};      // m^Dim/s; null: none
  std::shared_ptr<const SourceMotion> motion = {};  // null: none of its own
  int solid = -1;                                   // with which it moves; -1: none
  Pose pose = {};                                   // where it is now
  Twist twist = {};                                 // how it moves there

  Source(const LiquidSourceSpec& from, const std::string& path, double way,
         std::shared_ptr<const ShapeField<Dim>> region)
      : spec(from),
        name(path),
        sign(way),
        shape(std::move(region)),
        flow(std::make_shared<const VectorExpression>(from.velocity)) {
    if (from.rate) rate = std::make_shared<const Expression>(*from.rate);
    if (from.motion) motion = std::make_shared<const SourceMotion>(*from.motion);
  }

  bool moves() const { return motion || solid >= 0; }
  // Distance from the region, m.
  double distance(const Vec<Dim>& x) const {
    return moves() ? (*shape)(truncate<Dim>(pose.to_rest(extend<Dim>(x)))) : (*shape)(x);
  }
  // Velocity of the liquid that is added at x, m/s: against the region, which takes it along.
  Vec3 velocity(const Vec3& x, double t) const {
    return moves() ? Vec3(pose.rotation * (*flow)(pose.to_rest(x), t) + twist.at(x)) : (*flow)(x, t);
  }
  // True if that is the same everywhere.
  bool is_uniform() const { return flow->is_constant() && twist.angular.isZero(0); }
};

}  // namespace seiche
