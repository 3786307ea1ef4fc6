#pragma once
// The length of the next step.
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

struct TimeSpec;

// If solids have unknowns, a step is at most this factor longer than the last: contact is solved that far ahead.
constexpr double step_growth = 1.25;
// Message with figures if a fixed step of dt is too long, else empty: for the flow (collective), and for the solids'
// motions as placed.
template <int Dim>
std::string fault_of_pinned_flow(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                 const State<Dim>& state, double dt);
template <int Dim>
std::string fault_of_pinned_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const TimeSpec& time,
                                   const std::vector<Placement>& placed, double t, double dt);

// Length (s) of the coming step over which a step of dt (s) that leads to `next` solves for the solids' velocities: as
// planned if solids lead ahead, which makes their motion second order in time; else the longest that may follow.
// Collective.
template <int Dim>
double choose_horizon(const Setup<Dim>& setup, const State<Dim>& next, double dt);

// True if flow and solids after a solve allow a step of the planned length (State::planned). Collective.
template <int Dim>
bool can_go_as_planned(const Setup<Dim>& setup, const State<Dim>& state);

// Message if solids that plan steps cannot take the first one as a look ahead found it, else empty. h (m): a cell's
// width.
template <int Dim>
std::string fault_of_start(double h, const Solids<Dim>& solids, const State<Dim>& found);

// dt, or a shorter step in which no rigid body meets another solid and no element inverts. 0: none is short enough.
template <int Dim>
double hold_back(const Solids<Dim>& solids, const State<Dim>& state, double dt);

// Longest step (s) that the scene's limits allow now, ending at or before `until` (s). Throws Error(cannot_continue) if
// more than most_steps_a_frame such steps would remain, or a fixed step is too long; Error(bug) if `until` is not later
// than the state. Collective.
template <int Dim>
double choose_step(const Setup<Dim>& setup, const State<Dim>& state, double until);

// Note on long steps of viscous liquid that fills its domain, else empty. Over more than two cells, nothing is
// extrapolated in time. After 30 s, a cavity at Re = 5000 has 10 % less energy at Courant number 4 than at 1.
// Collective.
template <int Dim>
std::string note_on_long_steps(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                               const State<Dim>& state);

}  // namespace seiche
