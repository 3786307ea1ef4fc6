#pragma once
// Rotations and torque-free motion of rigid bodies. 2D bodies rotate about z and use the same functions.
#include <Eigen/Core>

#include "base/vec.h"

namespace seiche {

// Rotation by |w| radians about the direction of w.
Eigen::Matrix3d exp_rotation(const Vec3& w);
// Inverse of exp_rotation: the w of least length, |w| <= pi.
Vec3 log_rotation(const Eigen::Matrix3d& r);

// Inertia = axes diag(moments) axes', moments ascending (kg m^2). A moment below `thinnest_moment` of the largest
// counts as zero. Such a body (a thin rod about its own axis, a 2D body about x and y) has no spin about that axis.
struct PrincipalInertia {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // determinant 1
  Vec3 moments{0, 0, 0};
  Vec3 inverse_moments() const;  // 0 where the moment counts as zero
};
inline constexpr double thinnest_moment = 1e-12;  // well above the round-off of an inertia tensor, 1e-16

// inertia: symmetric tensor in any axes, positive semi-definite up to round-off.
PrincipalInertia principal_inertia(const Eigen::Matrix3d& inertia);

// Angular velocity for angular momentum l (world axes) of a body rotated by r since its inertia was computed.
Vec3 angular_velocity(const PrincipalInertia& inertia, const Eigen::Matrix3d& r, const Vec3& l);

struct FreeRotation {
  Eigen::Matrix3d rotation;             // at the end, orthonormal to round-off
  Vec3 mean_angular_velocity{0, 0, 0};  // exp_rotation(dt mean) * start = end, including whole turns; rad/s
};

// Torque-free motion over dt from orientation r with constant angular momentum l (N m s, world axes). Exact for bodies
// with two equal moments; otherwise second order by splitting.
FreeRotation rotate_freely(const PrincipalInertia& inertia, const Eigen::Matrix3d& r, const Vec3& l, double dt);

}  // namespace seiche
