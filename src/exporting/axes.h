#pragma once
// The axis that points up in exported files.
#include <string>

#include "exporting/bodies.h"
#include "exporting/liquid.h"

namespace seiche {
struct Scene;
}

namespace seiche::exporting {

// Unit vector against gravity at t = 0, along the nearest axis; y without gravity.
Vec3 up_of(const Scene& scene);

// A rotation by quarters of a turn about the origin, from axes of the scene to axes of the files.
class Turn {
 public:
  Turn() = default;  // none
  // Takes `up` to `to`, both along axes.
  Turn(const Vec3& up, const Vec3& to);

  Vec3 operator()(const Vec3& x) const { return rotation_ * x; }
  Pose operator()(const Pose& pose) const;
  void apply(SurfaceMesh& mesh) const;
  void apply(AttributedMesh& mesh) const;  // vectors too

 private:
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
};

}  // namespace seiche::exporting
