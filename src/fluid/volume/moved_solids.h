#pragma once
// Full cells beside solids that have moved. Flow and solids are known at one time each, so that what passes the faces
// of a cell differs from the change of its room by the square of the way: by up to a tenth of a cell in a step. What
// one cell has too much of, its neighbours lack.
#include "fluid/volume/ledger.h"
#include "grid/halo.h"

namespace seiche {

// Empties cells that solids have covered, and evens out the excess (V - K)/K of full cells near those whose room
// changed. phi (m) tells which are full: they lie deep in the liquid. Moves nothing between others. Ghosts must be
// filled, and are. `before`: shares at the start of the step. Collective.
template <int Dim>
void follow_moved_solids(const Layout<Dim>& layout, const Halo<Dim>& halo, const CellField<Dim>& phi,
                         const Ledger<Dim>& ledger, const CellField<Dim>& before, CellField<Dim>& share);

}  // namespace seiche
