#pragma once
// Liquid beside solids that have moved. Flow and solids are known at one time each, so that what passes the faces of a
// cell differs from the change of its room, by up to a tenth of a cell in a step. What one cell has too much of, its
// neighbours lack.
#include "fluid/volume/ledger.h"
#include "grid/halo.h"

namespace seiche {

// Cells near those whose room changes from K to K', and what a cell that is full before has beyond its room after a
// step of dt (s): m = K + (dt/h) sum w u - K', in cells. The sum is what comes in through the faces. m is 0 elsewhere.
template <int Dim>
struct RoomChange {
  CellField<Dim, char> near;
  CellField<Dim> mismatch;
};
template <int Dim>
RoomChange<Dim> change_of_room(const Layout<Dim>& layout, const Ledger<Dim>& ledger, const FaceField<Dim>& u,
                               double dt);

// Empties cells that solids have covered. Evens out among the cells of phi < 0 (m) near them what is out of place: all
// excess V - K deep in the liquid, elsewhere the liquid's part of the mismatch. Ghosts must be filled, and are.
// Collective.
template <int Dim>
void follow_moved_solids(const Layout<Dim>& layout, const Halo<Dim>& halo, const CellField<Dim>& phi,
                         const Ledger<Dim>& ledger, const RoomChange<Dim>& change, CellField<Dim>& share);

}  // namespace seiche
