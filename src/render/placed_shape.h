#pragma once
// The shape of a static or prescribed solid at one time.
#include <memory>

#include "geometry/shapes/shapes.h"

namespace seiche {
struct SolidSpec;
}

namespace seiche::render {

template <int Dim>
class PlacedShape {
 public:
  // `cell_size`: resolution of sampled shapes, m. Throws Error(bad_input) for shapes or motions that cannot be read.
  PlacedShape(const SolidSpec& solid, double cell_size, double time);
  // With the shape at rest.
  PlacedShape(const SolidSpec& solid, std::shared_ptr<const ShapeField<Dim>> shape, double time);

  // Signed distance at x (m), negative inside.
  double operator()(const Vec3& x) const;

  // Takes points to where they are in the rest pose, and back.
  Vec3 to_rest(const Vec3& x) const { return center_ + back_ * (x - translate_ - center_); }
  Vec3 place(const Vec3& rest) const { return translate_ + center_ + back_.transpose() * (rest - center_); }

 private:
  Vec3 center_, translate_ = Vec3::Zero();
  Eigen::Matrix3d back_ = Eigen::Matrix3d::Identity();
  std::shared_ptr<const ShapeField<Dim>> shape_;
};

}  // namespace seiche::render
