#pragma once
// The start of a run.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// The initial state of a scene. Throws Error(bad_input): solids overlap, a formula is not finite, or a fixed step is
// too long. Collective.
template <int Dim>
State<Dim> initial_state(const Setup<Dim>& setup);

}  // namespace seiche
