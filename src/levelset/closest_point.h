#pragma once
// Distance of a cell's centre to the zero of the cubic interpolant of a level set.
#include <optional>

#include "grid/fields.h"

namespace seiche {

// The nearest point of the zero: its signed distance in cells, and |grad phi| there.
struct Foot {
  double distance, slope;
};

// phi in cells, valid `reach` + 1 cells around. Empty where there is no zero within `reach` cells of the cell, where
// the search does not converge, or where phi is far from a distance: at corners, between two surfaces closer than some
// cells. Newton's steps along grad phi to the zero and across it to the point straight below (Chopp 2001).
template <int Dim>
std::optional<Foot> foot_on_zero(const Layout<Dim>& layout, const CellField<Dim>& phi, const IVec<Dim>& cell,
                                 double reach);

}  // namespace seiche
