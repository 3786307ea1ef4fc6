#pragma once
// What the viscous operator lacks beside no-slip solids, as forces known before the solve
// (docs/decisions/0067-flow-through-walls.md).
#include "coupling/transport/no_slip_solids.h"

namespace seiche {

// Loads on all solids, N and N m about their reference points, and power on the fluid relative to the solids, W.
struct WallForces {
  std::vector<SolidLoad> loads;
  double power = 0;
};

// Viscous stress by parabolas. Beside a wall the operator has the force mu h^(Dim-2) S at a face, S = D+ - D- the
// difference of slopes along each axis, D = (u_wall - u)/theta to the wall. The parabola through the three points has
// 2 w S/(theta- + theta+), w the open share of the face. Adds the difference to u_star (m/s), with the velocities at
// the start of the step; the opposite acts on the solid. Only constant viscosity, without gas that flows. Collective.
template <int Dim>
WallForces add_wall_viscosity(const Setup<Dim>& setup, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                              const StepGeometry<Dim>& geometry, double dt, FaceField<Dim>& u_star);

// Faces open in part with their centre in a solid start the step with its velocity. Their flow is in the fluxes of cut
// faces (fluid/viscosity/no_slip_flux), and their own velocity is a mean over the open part, which no face beside them
// may read as a point. Returns what they lose, as loads on solids that do not move freely, N. Collective.
template <int Dim>
std::vector<SolidLoad> stop_in_slits(const Setup<Dim>& setup, const NoSlipSolids<Dim>& solids, const State<Dim>& state,
                                     const StepGeometry<Dim>& geometry, double dt, FaceField<Dim>& u_star);

}  // namespace seiche
