#pragma once
// Coupling of a rigid body and the liquid through the faces that the body closes.
#include "coupling/solids/solid_coupling.h"
#include "solid/rigid/state.h"

namespace seiche {

// Sets the body's block of J, its fixed unknowns and its velocity without liquid (coupling.free); adds its mass matrix
// to parts.mass. Appends this rank's sums over the body's face shares to parts.sums. Collective.
template <int Dim>
void couple_rigid_body(const CoupledStep<Dim>& step, const Body<Dim>& body, const RigidState& r, int block,
                       CouplingParts<Dim>& parts);

// Sets buoyancy_correction of a body from the difference between its volume and that of its face shares; where jointed
// solids may reach into it, from the pieces of its surface that these leave open. Where the liquid's surface meets it,
// adds that of this rank's pieces to parts.missing. `sums`: over all ranks. Bodies that are not wholly within the
// domain get none. Collective.
template <int Dim>
void add_buoyancy(const CoupledStep<Dim>& step, const Body<Dim>& body, const RigidState& r, int block,
                  const double* sums, CouplingParts<Dim>& parts);

// Packs (v, omega) of a body into generalised coordinates (2D: v_x, v_y, omega_z; 3D: all six), and unpacks them from v
// at `first`.
template <int Dim>
Eigen::Matrix<double, twist_size<Dim>, 1> stacked(const Vec3& linear, const Vec3& angular);
template <int Dim>
Twist unstacked(const Eigen::VectorXd& v, int first, const Vec3& about);

}  // namespace seiche
