#pragma once
// Level set beside solids thinner than a cell: one surface does not say on which side of the solid it lies.
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

template <int Dim>
bool has_thin(const Solids<Dim>& solids);

// Keeps the liquid on its own side of thin solids. A cell beside a sealed face becomes wet or dry only if its own side
// held liquid or air in `known_phi`. The solids were `placed` then. `known_phi` must not be `phi`. The lookup uses the
// cells around the place that its centre had in the frame of the solid. Cells that the solid separates from that place
// do not count. phi does not measure the distance to a thin solid at which liquid ends. There the liquid counts as deep
// as in the cell behind. Ghosts filled. Collective.
template <int Dim>
void keep_sides_apart(const Domain<Dim>& domain, const Solids<Dim>& solids, const std::vector<Placement>& placed,
                      const CellField<Dim>& known_phi, const StepGeometry<Dim>& geometry, CellField<Dim>& phi);

}  // namespace seiche
