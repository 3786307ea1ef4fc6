#pragma once
// Forces that the viscous operator lacks beside no-slip solids, known before the solve
// (docs/decisions/0067-flow-through-walls.md).
#include "coupling/transport/no_slip_solids.h"
#include "fluid/viscosity/load_sums.h"

namespace seiche {

// Loads on all solids, N and N m about their reference points, and power on the fluid relative to the solids, W.
struct WallForces {
  std::vector<SolidLoad> loads;
  double power = 0;
};

// Viscous stress by parabolas. Beside a wall the operator has the force mu h^(Dim-2) S at a face, S = D+ - D- the
// difference of slopes along each axis, D = (u_wall - u)/theta to the wall. The parabola through the three points has
// 2 w S/(theta- + theta+), w the open share of the face. Adds the difference to u_star (m/s), with `flow`, the
// velocities at the start of the step continued through walls; the opposite acts on the solid. Only constant viscosity,
// without gas that flows. Collective.
template <int Dim>
WallForces add_wall_viscosity(const Setup<Dim>& setup, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                              const StepGeometry<Dim>& geometry, const FaceField<Dim>& flow, double dt,
                              FaceField<Dim>& u_star);

// Faces open in part with their centre in a solid ("slits") move with it. Their flow is in the fluxes of cut faces
// (fluid/viscosity/no_slip_flux). Sets u (m/s), that of the fluid `now` transported over dt (s) with its `gravity`
// (m/s^2), to the velocity with which the solve leaves them that of the solid; where viscosity is stiff, to their own:
// transport reads no mean over an open part, and gives none.
template <int Dim>
void stop_in_slits(const Domain<Dim>& domain, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                   const StepGeometry<Dim>& geometry, const TimeLevel<Dim>& now, const Vec3& gravity, double dt,
                   FaceField<Dim>& u);

// Adds the momentum that these faces lose by that in a step of dt (s), as loads on the solids, and their inertia. The
// pressure on the fluid that moves with the solids is part of the loads. Collective.
template <int Dim>
void add_slit_loads(const Setup<Dim>& setup, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                    const StepGeometry<Dim>& geometry, double dt, KnownLoads& loads);

}  // namespace seiche
