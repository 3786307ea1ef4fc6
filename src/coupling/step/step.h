#pragma once
// One step of liquid and solids.
#include "coupling/state/attempt.h"
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// Tries a step of dt (s) from `state`. Attempt::failure is empty, or not, on all ranks alike. Throws
// Error(cannot_continue) if a formula is not finite, or if solids prescribe a motion that closed liquid cannot follow.
// Collective.
template <int Dim>
[[nodiscard]] Attempt<Dim> attempt_step(const Setup<Dim>& setup, const State<Dim>& state, double dt, Phases& phases);

}  // namespace seiche
