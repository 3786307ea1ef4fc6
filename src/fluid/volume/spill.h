#pragma once
// Redistribution: liquid beyond a cell's capacity goes to its neighbours, and a negative amount is made up from them.
#include "base/communicator.h"
#include "fluid/volume/moved_solids.h"
#include "grid/halo.h"

namespace seiche {

// Volume moved by hand, in cells, over all ranks: all of it, and the most of one cell.
struct Spill {
  double moved = 0, worst = 0;
};

// phi (m) tells which cells are deep (ledger.h): they keep their excess. Three rounds, each from the shares before it,
// so that the result does not depend on the ranks. What finds no room stays. `change`: of the room where
// solids have moved, else not read. Fills ghosts. Collective.
template <int Dim>
Spill hand_on_excess(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                     const CellField<Dim>& phi, const Ledger<Dim>& ledger, const RoomChange<Dim>& change,
                     CellField<Dim>& share);

// Ghosts of shares; beyond sides those of the cells at them. Collective.
template <int Dim>
void fill_share_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, CellField<Dim>& share);

}  // namespace seiche
