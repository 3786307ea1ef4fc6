#pragma once
// Steps that move surface and rigid solids by halves, before and after the solve.
#include <algorithm>

#include "base/time_spec.h"
#include "coupling/state/features.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// x(t + dt/2) = x + dt/2 u,   u(t + dt) = u + dt a(x(t + dt/2)),   x(t + dt) = x(t + dt/2) + dt/2 u(t + dt)
//
// is the leapfrog, free of damping and stable to omega dt = 2 as x(t + dt) = x + dt u, u(t + dt) = u + dt a(x(t + dt))
// is, but of second order for steps of any lengths: there x lags by the sum of a dt^2/2, half a step of its motion, and
// of liquid let go from rest in long steps more. Not for elastic and thin solids, two fluids, enclosed air that keeps
// its volume, prescribed flows and first order; nor for rigid solids beside ones that move as prescribed: whether a
// scene has steps by halves at all.
bool may_leapfrog(const Features& features);

// Whether this step goes so. Near contact, where solids may meet within two steps, a step moves all at once, to where
// contact is then solved; so does one in which a source opens or closes. Collective.
template <int Dim>
bool is_leapfrog_step(const Solids<Dim>& solids, const std::vector<Source<Dim>>& sources, const Features& features,
                      const State<Dim>& state, double dt);

// Whether the velocities after the solve, half-way, can be gone on with for the other half: they cross no more cells
// than the halo and the solids bear, and no solid meets another. Those before the step can. Collective.
template <int Dim>
bool can_go_on(const Domain<Dim>& domain, const Solids<Dim>& solids, const TimeSpec& time, const State<Dim>& halfway,
               double dt);

// The solids where they stand half-way through the step that ends at state.time, prescribed ones with their twists over
// the whole of it.
template <int Dim>
std::vector<Placement> place_halfway(const State<Dim>& state, double dt);

// Whether solids move.
template <int Dim>
bool any_moves(const Solids<Dim>& solids) {
  return std::any_of(solids.bodies.begin(), solids.bodies.end(), [](const Body<Dim>& b) { return b.kind().moves(); });
}

// Of the geometry that was solved with, distances and poses as at the end of the step.
template <int Dim>
StepGeometry<Dim> placed_at_end(const Solids<Dim>& solids, const State<Dim>& end, StepGeometry<Dim> solved);

}  // namespace seiche
