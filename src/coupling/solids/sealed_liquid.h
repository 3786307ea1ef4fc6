#pragma once
// Cavities of elastic bodies that are full of liquid stay full.
#include "coupling/solids/cavity_volume.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Makes phi negative in cells of cavities that were sealed before the step: sealed liquid cannot leave. The same in
// cells that their walls cut. Not with gas (Feature::sealed_cavities): it may be sealed in, too. Fills ghosts.
// Collective.
template <int Dim>
void keep_sealed_full(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& before,
                      const State<Dim>& after, const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

// Marks the liquid of cavities that elastic bodies seal together with other solids (State::sealed). Collective.
template <int Dim>
void mark_sealed(const Domain<Dim>& domain, const Solids<Dim>& solids, const PressureRows<Dim>& rows,
                 const std::vector<CavityConstraint<Dim>>& cavities, State<Dim>& state);

}  // namespace seiche
