#pragma once
// Rotations and the free motion of rigid bodies. 2D bodies turn about z and use the same functions.
#include <Eigen/Core>

#include "base/vec.h"

namespace seiche {

// The rotation about the direction of w by |w| radians.
Eigen::Matrix3d exp_rotation(const Vec3& w);
// The w of least length with exp_rotation(w) = r; |w| <= pi.
Vec3 log_rotation(const Eigen::Matrix3d& r);

// Inertia = axes diag(moments) axes', moments ascending (kg m^2). A moment below `thinnest_moment` of the largest
// counts as none: such a body (a thin rod about its own axis, a 2D body about x and y) has no spin about it.
struct PrincipalInertia {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // of determinant 1
  Vec3 moments{0, 0, 0};
  Vec3 inverse_moments() const;  // 0 where there is no moment
};
inline constexpr double thinnest_moment = 1e-12;  // far above the round-off of an inertia tensor, 1e-16

// Of a symmetric tensor in any axes, positive semi-definite up to round-off.
PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia);

// The angular velocity of a body that has turned by r since its inertia was taken, for angular momentum l (world axes).
Vec3 angular_velocity(const PrincipalInertia& inertia, const Eigen::Matrix3d& r, const Vec3& l);

struct FreeRotation {
  Eigen::Matrix3d rotation;             // at the end, orthonormal to round-off
  Vec3 mean_angular_velocity{0, 0, 0};  // exp_rotation(dt mean) * start = end, whole turns included; rad/s
};

// The torque-free motion over dt of a body with orientation r and angular momentum l (N m s, world axes), which stays
// as it is. Exact for bodies with two equal moments; otherwise split into steps, second order.
FreeRotation rotate_freely(const PrincipalInertia& inertia, const Eigen::Matrix3d& r, const Vec3& l, double dt);

}  // namespace seiche
