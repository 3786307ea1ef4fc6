#pragma once
// Distance of a cell centre from the zero set of a level set's cubic interpolant.
#include <optional>

#include "grid/fields.h"

namespace seiche {

// The nearest point of the zero set: signed distance in cells, and |grad phi| there.
struct Foot {
  double distance, slope;
};

// phi in cells, valid `reach` + 1 cells around. Each iteration combines a Newton step along grad phi with a tangential
// step to the foot of the perpendicular (Chopp 2001). Empty if no zero is within `reach` cells along each axis or the
// search does not converge. Empty also if phi is far from a distance: at corners and between surfaces a few cells
// apart.
template <int Dim>
std::optional<Foot> foot_on_zero(const Layout<Dim>& layout, const CellField<Dim>& phi, const IVec<Dim>& cell,
                                 double reach);

}  // namespace seiche
