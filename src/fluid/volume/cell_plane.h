#pragma once
// The plane that stands for the surface in a cell (PLIC): liquid where normal.x < offset, x in cells from the cell's
// low corner.
#include "base/vec.h"

namespace seiche {

template <int Dim>
struct CellPlane {
  Vec<Dim> normal;  // out of the liquid, of length 1
  double offset = 0;
};

// Share of the unit cube with normal.x < offset (Scardovelli, Zaleski 2000, eqs. 1-9).
template <int Dim>
double share_below(const Vec<Dim>& normal, double offset);

// Inverse: the offset below which the given share of the unit cube lies, to `error` of it. share in [0, 1].
template <int Dim>
double offset_of_share(const Vec<Dim>& normal, double share, double error = 1e-16);

}  // namespace seiche
