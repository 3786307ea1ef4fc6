#pragma once
// Where the solids stand and how they move: rigid ones as the solve left them, the others as prescribed.
#include <vector>

#include "solid/body/body.h"

namespace seiche {

// Of one rigid body; the same bits on all ranks.
struct RigidState {
  Vec3 center{0, 0, 0};                                    // of mass, m
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // from rest
  Vec3 velocity{0, 0, 0};                                  // of the centre of mass, m/s
  Vec3 angular_velocity{0, 0, 0};                          // mean over the coming `horizon`, rad/s
  Vec3 angular_momentum{0, 0, 0};                          // about the centre of mass, kg m^2/s
  double horizon = 0;                                      // s
  Vec3 extra_force{0, 0, 0}, extra_torque{0, 0, 0};        // from the liquid beyond its pressure on the faces, N, N m
};

struct Placement {
  Pose pose;
  Twist twist;
  // Of an elastic body: displacements and velocities of its nodes, stacked node by node (m, m/s).
  Eigen::VectorXd displacement, velocity;
};

// Rest pose and initial velocities.
template <int Dim>
RigidState initial_rigid_state(const Body<Dim>& body);

// Inertia about the centre of mass in world axes, kg m^2.
template <int Dim>
Eigen::Matrix3d world_inertia(const Body<Dim>& body, const RigidState& r);

template <int Dim>
Pose rigid_pose(const Body<Dim>& body, const RigidState& r);

// Whether none of its axes of rotation is fixed.
bool turns_freely(const RigidSpec& spec);

// Moves by the twist of the last solve: x += dt v, R <- exp(dt w) R, w changed to what a free rotation over dt instead
// of the horizon would have.
template <int Dim>
RigidState advance(const Body<Dim>& body, const RigidState& r, double dt);

// Velocity after `dt` without liquid and contact: v + dt g, and the mean angular velocity of the body's free rotation
// over the horizon to come. Fixed axes stay at rest.
template <int Dim>
Twist free_twist(const Body<Dim>& body, const RigidState& r, const Vec3& gravity, double dt, double horizon);

}  // namespace seiche
