#include "exporting/axes.h"

#include "base/gravity.h"
#include "base/scene.h"

namespace seiche::exporting {

Vec3 up_of(const Scene& scene) {
  const Vec3 g = Gravity(scene.gravity).at(0);
  if (!(g.norm() > 0)) return Vec3::UnitY();
  int axis = 1;
  g.cwiseAbs().maxCoeff(&axis);
  return g[axis] < 0 ? Vec3::Unit(axis) : Vec3(-Vec3::Unit(axis));
}

Turn::Turn(const Vec3& up, const Vec3& to) {
  const Eigen::Quaterniond least = Eigen::Quaterniond::FromTwoVectors(up, to);
  rotation_ = least.toRotationMatrix().array().round();  // exact: its entries are 0, 1 and -1
}

// The body's own axes turn too: R q R^T.
Pose Turn::operator()(const Pose& pose) const {
  const Eigen::Quaterniond turn(rotation_);
  return {rotation_ * pose.position, turn * pose.orientation * turn.conjugate()};
}

void Turn::apply(SurfaceMesh& mesh) const {
  for (Vec3& x : mesh.points) x = rotation_ * x;
}

void Turn::apply(AttributedMesh& mesh) const {
  apply(mesh.mesh);
  for (mesh::PointAttribute& attribute : mesh.attributes) {
    if (attribute.components != 3) continue;
    for (std::size_t n = 0; n + 3 <= attribute.values.size(); n += 3) {
      const Eigen::Map<Eigen::Vector3f> v(attribute.values.data() + n);
      Eigen::Map<Eigen::Vector3f>(attribute.values.data() + n) = (rotation_.cast<float>() * v).eval();
    }
  }
}

}  // namespace seiche::exporting
