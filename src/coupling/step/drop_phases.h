#pragma once
// Phases of a step that concern drops. They do nothing where the air has a pressure, or the scene prescribes the flow.
#include "coupling/state/attempt.h"
#include "coupling/step/surface_phases.h"

namespace seiche {

// Flies drops to the time of the solve, before volumes and level set are coupled there. Those that reach liquid or each
// other join them. Returns why they cannot fly, or "". Collective.
template <int Dim>
std::string land_before_solve(const Setup<Dim>& setup, const StepTimes& times, Moved<Dim>& moved);

// Makes drops of the liquid that the level set knows nothing of after both were coupled. Moved::landed then has
// velocities at the end of the step. Collective.
template <int Dim>
void make_before_solve(const Setup<Dim>& setup, const State<Dim>& before, const StepTimes& times, Moved<Dim>& moved);

// Flies drops from the solve to the end of the step. Returns why they cannot fly, or "". Collective.
template <int Dim>
std::string fly_after_solve(const Setup<Dim>& setup, const StepTimes& times, Attempt<Dim>& solved);

}  // namespace seiche
