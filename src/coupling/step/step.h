#pragma once
// One step of liquid and solids.
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Tries a step of dt from `state`. Attempt::failure is empty, or not, on all ranks alike. Collective.
template <int Dim>
[[nodiscard]] Attempt<Dim> attempt_step(const Setup<Dim>& setup, const State<Dim>& state, double dt, Phases& phases);

}  // namespace seiche
