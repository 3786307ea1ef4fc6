#pragma once
// The length of the next step.
#include "base/time_spec.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// With bodies in contact a step is at most this much longer than the last one: contact is solved that far ahead.
constexpr double step_growth = 1.25;
// Why a pinned step of dt cannot be taken, with figures; empty where it can: for the flow (collective), and for the
// solids' motions as placed.
template <int Dim>
std::string fault_of_pinned_flow(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                 const State<Dim>& state, double dt);
template <int Dim>
std::string fault_of_pinned_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const TimeSpec& time,
                                   const std::vector<Placement>& placed, double t, double dt);

// How far ahead a step that led to `next` after dt solves for the solids' velocities. Where there are elastic solids
// the coming step is meant to be just that long: their motion is second order in time then.
template <int Dim>
double choose_horizon(const Setup<Dim>& setup, const State<Dim>& next, double dt);

// Whether the flow and the solids after a solve allow a step of the length that it was planned for (State::horizon).
// Collective.
template <int Dim>
bool can_go_as_planned(const Setup<Dim>& setup, const State<Dim>& state);

// dt, or as much shorter as it takes that no rigid body meets another solid on the way; 0 where nothing is short
// enough.
template <int Dim>
double hold_back(const Solids<Dim>& solids, const State<Dim>& state, double dt);

// The longest step the scene's limits allow now, ending at or before `until`. Throws Error(cannot_continue) where that
// is hopelessly short, or where a pinned step is too long.
template <int Dim>
double choose_step(const Setup<Dim>& setup, const State<Dim>& state, double until);

}  // namespace seiche
