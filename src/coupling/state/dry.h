#pragma once
// Scenes of solids alone.
#include "coupling/state/setup.h"

namespace seiche {

// True if no fluid is ever there and no solid deforms. Steps then leave the grid alone.
template <int Dim>
bool is_dry(const Setup<Dim>& setup);

}  // namespace seiche
