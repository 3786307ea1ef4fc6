#pragma once
// The height that liquid may fall.
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Mean height over which liquid has to fall at t = 0 until it lies flat in the room around it, which static solids
// bound, m.
// By whole cells; 0 without gravity. Collective; equal on all ranks.
template <int Dim>
double fall_of_liquid(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                      const State<Dim>& state, const StepGeometry<Dim>& geometry);

}  // namespace seiche
