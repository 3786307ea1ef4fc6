#pragma once
// phi within solids: whose liquid or air it stands for.
#include "coupling/state.h"

namespace seiche {

// In elastic bodies phi is carried with velocities known next to their surface alone; farther in it stays behind when
// they move, and liquid of one side of a thick wall would come out at the other. From the depth of 1.5 cells on, for a
// few layers, phi whose sign is not that of the nearest place outside (the mean of the neighbours a layer nearer to it)
// is set to what it is there: between liquid and air the surface lies midway. Elsewhere phi is left alone. Fills
// ghosts. Collective.
template <int Dim>
void keep_sides_of_walls(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

}  // namespace seiche
