#pragma once
// The pressure at a point beside solids, from cells on the point's own side of them.
#include <optional>

#include "coupling/geometry/step_geometry.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Pressure at x (Pa) by a linear fit to cells around x. They have a pressure, belong to the point's fluid (`liquid`)
// and lie at most half a cell deep in a solid. The first one is nearest to x + h n/2, with n the outward normal of the
// nearest solid. Open faces join the others to it. Empty if there is no first cell, or if open faces join all such
// cells: no solid then separates cells near x. Collective; equal on all ranks.
template <int Dim>
std::optional<double> pressure_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                             const State<Dim>& state, const StepGeometry<Dim>& geometry,
                                             const Vec<Dim>& x, bool liquid);

}  // namespace seiche
