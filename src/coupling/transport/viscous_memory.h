#pragma once
// The part of the viscous term that a step takes from earlier ones.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "coupling/transport/viscous_transport.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Explicit part of the viscous term as a velocity increment, m/s:
//   dt (c2 N(t) + c3 N(t - dt_now)),   N the viscous acceleration, N(t - dt_now) transported along the path.
// Together with the implicit share c1 (ViscousPlan::implicit), c1 N(t + dt) + c2 N(t) + c3 N(t - dt_now) is N(t + dt/2)
// to second order. For c1 = 1 the explicit part is a trend, -dt^2/(2 dt_now) (N(t) - N(t - dt_now)) times
// trust_in_viscous_trend(). Zero where either level is unknown, for dt > 2 dt_now, and in first order. `interior`:
// faces where the path and the stencils at its end read solved liquid alone
// (docs/decisions/0026-steady-flow-and-steps.md). Ghosts filled. Collective.
template <int Dim>
FaceField<Dim> viscous_memory(const Domain<Dim>& domain, const Fluids& fluids, TimeScheme scheme,
                              const State<Dim>& state, const Flow<Dim>& flow, const FaceField<Dim, char>& interior,
                              double dt, const ViscousPlan& plan);

}  // namespace seiche
