#pragma once
// Steps of solids alone.
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/step/solid_phases.h"

namespace seiche {

// One step of a scene that is_dry(), as attempt_step() takes it, but without the grid: flow, surface and pressure stay.
// The geometry of the result has no distances. Collective.
template <int Dim>
Attempt<Dim> attempt_dry_step(const Setup<Dim>& setup, const State<Dim>& before, const StepTimes& times,
                              Phases& phases);

}  // namespace seiche
