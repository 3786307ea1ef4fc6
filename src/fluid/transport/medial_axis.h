#pragma once
// One-sided interpolation of a distance phi at its medial axis: the middle of threads, sheets and gaps a few cells
// thick.
#include "grid/layout.h"

namespace seiche {

// phi at index coordinates g. Equals interpolate_cubic bit by bit if phi is smooth at the 4^Dim points around or at
// least two cells from its zero; else one-sided (docs/decisions/0023-kinks.md). Equivariant under rotations of the
// grid.
template <int Dim>
double interpolate_beside_medial_axis(const Layout<Dim>& layout, const double* phi, const Vec<Dim>& g);

}  // namespace seiche
