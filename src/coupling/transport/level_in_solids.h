#pragma once
// phi within solids: whose liquid or air it stands for.
#include "coupling/state/state.h"

namespace seiche {

// In elastic bodies phi is carried with the body's velocity next to its surface alone; farther in it stays behind when
// they move, and liquid of one side of a thick wall would come out at the other. From the depth of 1.5 cells on, for
// four layers, phi whose sign is not that of the nearest cells less deep (the mean of the neighbours a layer nearer to
// them) is set to what it is there. What is less deep counts as it is, also along sides and solids that the body
// touches. Elsewhere phi is left alone. Fills ghosts. Collective.
template <int Dim>
void keep_sides_of_walls(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

}  // namespace seiche
