#pragma once
// Liquid by the level set in a cell, as seen from the cell's own side of solids. phi in cells that solids fill, and
// across thin walls, stands for other liquid or air, and changes while the surface outside rests.
#include "fluid/volume/room.h"
#include "levelset/fractions.h"

namespace seiche {

// phi (m) in a cell and around it. Cells that no path of open faces joins to it have phi continued straight: by the
// slope of least squares in the joined ones. phi must be valid one cell around.
template <int Dim>
ValuesAround<Dim> values_on_own_side(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                                     Site cell);

// liquid_share() and share_and_area() of a cell with these values.
template <int Dim>
double liquid_share(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                    const NodeField<Dim>& psi, Site cell);
template <int Dim>
VolumeAndArea share_and_area(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                             const NodeField<Dim>& psi, Site cell);

}  // namespace seiche
