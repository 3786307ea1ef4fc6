#pragma once
// The look ahead: a trial of the first step that finds how solids that plan steps set off.
#include "coupling/state/solids.h"
#include "coupling/state/state.h"

namespace seiche {

// The velocities of a step come from the solve before it. At the start there is none, and such solids would stand still
// for a step. A look ahead solves for the first step with solids and surface where they begin.
//
// True if solids plan steps, none of them touches liquid, and no gas flows. A look ahead would set fluid beside them in
// motion. The first step would start it from rest again and take its momentum from the solids twice. Collective.
template <int Dim>
bool can_look_ahead(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& start,
                    const StepGeometry<Dim>& geometry);

// Gives the start the velocities that a look ahead found.
template <int Dim>
void set_off(const State<Dim>& found, State<Dim>& start);

}  // namespace seiche
