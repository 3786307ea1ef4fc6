#pragma once
// Leapfrog steps: surface and rigid solids move half a step before and half a step after the solve.
#include <algorithm>

#include "coupling/state/features.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct TimeSpec;

// The leapfrog
//   x(t + dt/2) = x + dt/2 u,   u(t + dt) = u + dt a(x(t + dt/2)),   x(t + dt) = x(t + dt/2) + dt/2 u(t + dt)
// is undamped, stable to omega dt = 2, and second order for steps of any lengths. Whole steps, x(t + dt) = x + dt u,
// u(t + dt) = u + dt a(x(t + dt)), are undamped and as stable. Their x is late by the sum of a dt^2/2: half a step of
// motion, or more if liquid is released from rest in long steps.
//
// True if the scene may have leapfrog steps. It may not with elastic and thin solids, two fluids, enclosed air that
// keeps its volume, prescribed flows and first order. The same holds for rigid solids beside prescribed ones.
bool may_leapfrog(const Features& features);

// True if this step is a leapfrog step. If solids may meet within two steps, they move the whole step before the solve
// and contact is solved there. The same holds if a source opens or closes in the step. Collective.
template <int Dim>
bool is_leapfrog_step(const Solids<Dim>& solids, const std::vector<Source<Dim>>& sources, const Features& features,
                      const State<Dim>& state, double dt);

// True if the velocities after the solve can be used for the second half step. They must cross no more cells than
// redistancing and the solids permit, and no solids may meet. Else those before the step are used. Collective.
template <int Dim>
bool can_go_on(const Domain<Dim>& domain, const Solids<Dim>& solids, const TimeSpec& time, const State<Dim>& halfway,
               double dt);

// As far as solids are concerned. Collective.
template <int Dim>
bool solids_can_go_on(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& halfway, double dt);

// Places of the solids at the middle of the step that ends at state.time. Prescribed ones have the twists of the whole
// step.
template <int Dim>
std::vector<Placement> place_halfway(const State<Dim>& state, double dt);

// True if any solid moves.
template <int Dim>
bool any_moves(const Solids<Dim>& solids) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(), [](const Body<Dim>& b) { return b.moves(); });
}

// The geometry of the solve with the distances psi and the poses of the end of the step.
template <int Dim>
StepGeometry<Dim> placed_at_end(const Solids<Dim>& solids, const State<Dim>& end, StepGeometry<Dim> solved);

}  // namespace seiche
