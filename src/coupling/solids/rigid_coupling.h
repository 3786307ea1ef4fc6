#pragma once
// How rigid bodies and liquid act on each other through the faces that the bodies close.
#include "coupling/solids/solid_coupling.h"

namespace seiche {

// Fills in what concerns the rigid bodies: their blocks of J, masses, velocities without liquid. Collective.
template <int Dim>
void couple_rigid_bodies(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, const PressureRows<Dim>& rows,
                         const State<Dim>& state, double dt, double horizon, CouplingParts<Dim>& parts);

// (v, omega) of a body and back: 3D all six, 2D v_x, v_y, omega_z.
template <int Dim>
Eigen::Matrix<double, twist_size<Dim>, 1> stacked(const Vec3& linear, const Vec3& angular);
template <int Dim>
Twist unstacked(const Eigen::VectorXd& v, int first, const Vec3& about);

// A rigid body after a solve gave it the velocity v: its twist in the geometry, its momenta in the state.
template <int Dim>
void set_rigid_velocity(const Setup<Dim>& setup, const SolidCoupling<Dim>& coupling, int body, int first,
                        const Eigen::VectorXd& v, StepGeometry<Dim>& geometry, RigidState& state);

}  // namespace seiche
