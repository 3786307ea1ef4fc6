#pragma once
// Loads on free solids that are known before the solve.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/viscosity/load_sums.h"

namespace seiche {

// Adds the impulse of loads over a step of dt (s) to the push on each solid that is free and does not deform. Fixed
// unknowns get none. Fluid with the inertia G that moves with a solid of the inertia M takes part in its change of
// velocity: of the impulse i for carrying it, M (M + G)^-1 i is added. Added as a whole, it makes a solid lighter than
// this fluid unstable.
template <int Dim>
void push_by(const KnownLoads& loads, const Participants<Dim>& solids, const StepGeometry<Dim>& geometry, double dt,
             SolidCoupling<Dim>& coupling);

}  // namespace seiche
