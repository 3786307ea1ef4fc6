#pragma once
// Interpolation of a distance phi across its kinks: the middle of threads, sheets and gaps a few cells thick.
#include "grid/layout.h"

namespace seiche {

// phi at index coordinates g: interpolate_cubic, its bits too, where the 4^Dim points around are smooth or phi is more
// than two cells from its zero; else one-sided (docs/decisions/0023-kinks.md). The same under turns of the grid.
template <int Dim>
double interpolate_beside_medial_axis(const Layout<Dim>& layout, const double* phi, const Vec<Dim>& g);

}  // namespace seiche
