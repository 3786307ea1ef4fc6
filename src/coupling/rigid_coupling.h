#pragma once
// How rigid bodies and liquid act on each other through the faces that the bodies close.
#include "coupling/state.h"
#include "solid/rigid_problem.h"

namespace seiche {

template <int Dim>
struct RigidCoupling {
  std::vector<int> bodies;  // indices of the rigid ones
  // (J v)_c = sum_f +- s_f v(x_f).e_f: volume that the bodies' motion takes out of cell c, per face area. A_f J' p is
  // the force and torque of the pressure p. Columns of fixed axes are zero.
  BlockColumns J;
  // Force and torque that make up for the difference between a body's volume and the one its face shares add up to, so
  // that wet bodies feel exactly rho g times their volume, at their centre (N, N m), stacked as J's columns.
  Eigen::VectorXd buoyancy_correction;
  Eigen::VectorXd target;  // v*: velocities without liquid and contact, the correction included
  Eigen::VectorXd free;    // the same without the correction
  SmallMatrix mass;        // M
  std::vector<Freedom> freedom;
};

// Collective.
template <int Dim>
RigidCoupling<Dim> couple_rigid_bodies(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry,
                                       const PressureRows<Dim>& rows, const std::vector<RigidState>& rigid, double dt,
                                       double horizon);

// (v, omega) of a body and back: 3D all six, 2D v_x, v_y, omega_z.
template <int Dim>
Eigen::Matrix<double, twist_size<Dim>, 1> stacked(const Vec3& linear, const Vec3& angular);
template <int Dim>
Twist unstacked(const Eigen::VectorXd& v, int first, const Vec3& about);

// The bodies after a solve gave them the velocities v: twists in the geometry, momenta in the states.
template <int Dim>
void set_velocities(const Setup<Dim>& setup, const RigidCoupling<Dim>& coupling, const Eigen::VectorXd& v,
                    StepGeometry<Dim>& geometry, std::vector<RigidState>& rigid);

}  // namespace seiche
