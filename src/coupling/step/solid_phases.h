#pragma once
// Phases of a step that move solids.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// A step from `start` to start + dt. The solve finds surface and solids `lead` after the start: half-way in a leapfrog
// step (leapfrog.h), else at the end. A look ahead (lead 0) leaves them at the start: its solve finds how solids that
// plan steps set off.
struct StepTimes {
  double start, dt, lead;  // s
  bool leapfrog;

  bool looks_ahead() const { return lead == 0; }
};

// The state at the end of the step as far as it follows from its length alone.
template <int Dim>
State<Dim> shifted_levels(const State<Dim>& before, const StepTimes& times);

// Moves the solids of `next` to where the solve finds them, and closes their joints there. Returns why they cannot
// move, or "". Collective.
template <int Dim>
std::string move_solids(const Setup<Dim>& setup, const State<Dim>& before, const StepTimes& times, State<Dim>& next);

// Places of the solids at the solve. Prescribed ones have their mean velocity over the step.
template <int Dim>
std::vector<Placement> place_at_solve(const State<Dim>& next, const StepTimes& times);

// The second half of a leapfrog step by the velocities that `leading` has.
template <int Dim>
void go_on(const State<Dim>& leading, const StepTimes& times, State<Dim>& next);

// Shows solids at the end of the step where their interactions hold.
template <int Dim>
void show_solids(const Setup<Dim>& setup, State<Dim>& state);

}  // namespace seiche
