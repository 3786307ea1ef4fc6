#pragma once
// Volume that comes into cells from beyond the flow.
#include "coupling/state/drops.h"
#include "fluid/volume/room.h"
#include "fluid/volume/volume_transport.h"
#include "grid/halo.h"

namespace seiche {

// Adds volumes to owned cells, as shares of them. What a cell has no room for goes to those around it with phi (m) less
// than a cell, by their room; what finds none stays. Ghosts of phi and share must be filled; those of `share` are
// filled afterwards. Results do not depend on the ranks. Collective.
template <int Dim>
void add_by_room(const Layout<Dim>& layout, const Halo<Dim>& halo, const Room<Dim>& room, const CellField<Dim>& phi,
                 const CellValues& volumes, CellField<Dim>& share);

// Shares of liquid with those of drops in their cells. Fills ghosts. Collective.
template <int Dim>
CellField<Dim> share_with_drops(const Layout<Dim>& layout, const Halo<Dim>& halo, const Drops<Dim>& drops,
                                CellField<Dim> share);

}  // namespace seiche
