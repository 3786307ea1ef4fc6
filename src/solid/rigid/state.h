#pragma once
// Poses and velocities of the solids: rigid ones after the last solve, others as prescribed.
#include <vector>

#include "solid/body/body.h"

namespace seiche {

// State of one rigid body; bitwise equal on all ranks.
struct RigidState {
  Vec3 center{0, 0, 0};                                    // of mass, m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // from rest
  Vec3 velocity{0, 0, 0};                                  // of the centre of mass, m/s
  Vec3 angular_velocity{0, 0, 0};                          // mean over the coming `horizon`, rad/s
  Vec3 angular_momentum{0, 0, 0};                          // about the centre of mass, kg m^2/s
  double horizon = 0;                                      // s
  Vec3 extra_force{0, 0, 0}, extra_torque{0, 0, 0};        // from the liquid, without the pressure on the faces; N, N m
  // Between two solves a jointed body is shown where its joints are closed, off its straight way by this much: a
  // displacement of its centre (m) and a rotation vector (rad), taken back before it moves on.
  Vec3 shown_shift{0, 0, 0}, shown_turn{0, 0, 0};
};

struct Placement {
  Pose pose;
  Twist twist;
  // Elastic bodies: nodal displacements and velocities, stacked node by node (m, m/s).
  Eigen::VectorXd displacement, velocity;
};

// Rest pose with the scene's initial velocities.
template <int Dim>
RigidState initial_rigid_state(const Body<Dim>& body);

// Inertia about the centre of mass in world axes, kg m^2.
template <int Dim>
Eigen::Matrix3d world_inertia(const Body<Dim>& body, const RigidState& r);

template <int Dim>
Pose rigid_pose(const Body<Dim>& body, const RigidState& r);

// True if no axis of rotation is fixed.
bool turns_freely(const RigidSpec& spec);

// Moves by the velocities of the last solve: x += dt v, R <- exp(dt w) R. w is corrected to a free rotation over dt
// instead of the horizon.
template <int Dim>
RigidState advance(const Body<Dim>& body, const RigidState& r, double dt);

// After a solve over `horizon` that found `now`; `free`: angular velocity of free rotation over it.
//   L += I (omega - omega*), the impulse of liquid, contact and joints. With a fixed axis L = I omega.
template <int Dim>
RigidState led_by(const Body<Dim>& body, const RigidState& r, const Twist& now, const Vec3& free, double horizon);

// Second half of a leapfrog step, dt (s), with the velocities of `led`.
template <int Dim>
RigidState gone_on(const Body<Dim>& body, const RigidState& r, const RigidState& led, double dt);

// Displaced by `shift` (m) and turned about its centre by the rotation vector `turn` (rad).
RigidState displaced(RigidState r, const Vec3& shift, const Vec3& turn);
// Its place on its straight way.
RigidState not_shown(const RigidState& r);

// Velocity after `dt` without liquid and contact: v + dt g, and the mean angular velocity of free rotation over the
// coming horizon. Fixed axes do not move.
template <int Dim>
Twist free_twist(const Body<Dim>& body, const RigidState& r, const Vec3& gravity, double dt, double horizon);

}  // namespace seiche
