#pragma once
// Loads on free solids that are known before the solve.
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"

namespace seiche {

// Adds the impulse of `loads` (one a solid, about its reference point; empty: none) over a step of dt (s) to the push
// on each solid that is free and does not deform. Fixed unknowns get none.
template <int Dim>
void push_by(const std::vector<SolidLoad>& loads, const Participants<Dim>& solids, const StepGeometry<Dim>& geometry,
             double dt, SolidCoupling<Dim>& coupling);

}  // namespace seiche
