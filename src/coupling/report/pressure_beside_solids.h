#pragma once
// The pressure at a point beside solids, from cells on the point's own side of them.
#include <optional>

#include "coupling/geometry/step_geometry.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Fit p(x) = a + b.x to the cells around x whose centres lie in the point's fluid, at most half a cell deep in a solid,
// and which open faces join to the cell that the nearest solid's normal leads to. Pa; empty if there is no such cell,
// or none near that a solid parts from it. `liquid`: the point's fluid. Collective; equal on all ranks.
template <int Dim>
std::optional<double> pressure_beside_solids(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                             const State<Dim>& state, const StepGeometry<Dim>& geometry,
                                             const Vec<Dim>& x, bool liquid);

}  // namespace seiche
