#pragma once
// How the surface goes on behind walls and in solids so that it meets them at its contact angle.
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// phi (m), continued beyond walls and into solids: along them the same as inside, shifted towards the air by cot(angle)
// a unit of depth, so that the surface's mean slope over the wall is that of the angle (for curvature; after Sussman
// 2001 and Afkhami, Bussmann 2008). Where the surface runs along a wall as a film it goes straight on. Inside the flow
// phi is as given. Ghosts filled. Collective.
template <int Dim>
CellField<Dim> continue_at_contact_angle(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                         const StepGeometry<Dim>& geometry, const CellField<Dim>& phi);

}  // namespace seiche
