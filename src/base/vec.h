#pragma once
// Small fixed-size vectors. 3-vectors describe scenes of either dimension (z = 0 in 2D).
#include <Eigen/Core>

namespace seiche {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using IVec = Eigen::Matrix<int, Dim, 1>;
using Vec3 = Vec<3>;

// The first Dim components of a scene vector.
template <int Dim>
Vec<Dim> truncate(const Vec3& v) {
  return v.head<Dim>();
}

// A Dim-vector as a scene vector; missing components are zero.
template <int Dim>
Vec3 extend(const Vec<Dim>& v) {
  Vec3 r = Vec3::Zero();
  r.head<Dim>() = v;
  return r;
}

// [a]x with [a]x b = a x b.
inline Eigen::Matrix3d cross_matrix(const Vec3& a) {
  Eigen::Matrix3d m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

}  // namespace seiche
