#pragma once
// How a rigid body and liquid act on each other through the faces that the body closes.
#include "coupling/solids/solid_coupling.h"
#include "solid/rigid/state.h"

namespace seiche {

// Adds the body's block of J, its mass, its velocity without liquid; and what its faces add up to on this rank to
// parts.sums. Collective.
template <int Dim>
void couple_rigid_body(const CoupledStep<Dim>& step, const Body<Dim>& body, const RigidState& r, int block,
                       CouplingParts<Dim>& parts);

// What makes up for the difference between the volume of body k and that of its faces; `sums` are those over all ranks.
template <int Dim>
void add_buoyancy(const CoupledStep<Dim>& step, const Body<Dim>& body, int k, int first, const double* sums,
                  SolidCoupling<Dim>& coupling);

// (v, omega) of a body and back: 3D all six, 2D v_x, v_y, omega_z.
template <int Dim>
Eigen::Matrix<double, twist_size<Dim>, 1> stacked(const Vec3& linear, const Vec3& angular);
template <int Dim>
Twist unstacked(const Eigen::VectorXd& v, int first, const Vec3& about);

}  // namespace seiche
