#pragma once
// The level set as the distance from the pieces of the volumes.
#include "fluid/volume/ledger.h"

namespace seiche {

// Sets phi (m) in the marked owned cells and around them to the distance from the pieces of the cells within two, at
// most two cells. `old`: the level set whose normals the pieces have where it is smooth. share: of liquid, in each
// cell. Fields must be valid four cells around the owned ones, marks one. Returns the number of cells.
template <int Dim>
std::int64_t rebuild_level_set(const Layout<Dim>& layout, const CellField<Dim, char>& marked, const CellField<Dim>& old,
                               const Ledger<Dim>& ledger, const CellField<Dim>& share, CellField<Dim>& phi);

}  // namespace seiche
