#pragma once
// Cavities of elastic bodies that are full of liquid stay full.
#include "coupling/solids/cavity_volume.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Where a cavity was sealed before the step, phi counts its cells, and those that its wall cuts, as liquid: they have
// nowhere to go. Does nothing where gas flows, which may be sealed in, too. Fills ghosts. Collective.
template <int Dim>
void keep_sealed_full(const Setup<Dim>& setup, const State<Dim>& before, const State<Dim>& after,
                      const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

// Takes note of the liquid in cavities that elastic bodies and others seal together (State::sealed). Collective.
template <int Dim>
void mark_sealed(const Domain<Dim>& domain, const Solids<Dim>& solids, const PressureRows<Dim>& rows,
                 const std::vector<CavityConstraint<Dim>>& cavities, State<Dim>& state);

}  // namespace seiche
