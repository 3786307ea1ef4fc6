#pragma once
// Cavities of elastic bodies that are full of liquid stay full.
#include "coupling/state.h"

namespace seiche {

// Where a cavity was sealed before the step, phi counts its cells, and those that its wall cuts, as liquid: they have
// nowhere to go. Fills ghosts. Collective.
template <int Dim>
void keep_sealed_full(const Setup<Dim>& setup, const State<Dim>& before, const State<Dim>& after, CellField<Dim>& phi);

}  // namespace seiche
