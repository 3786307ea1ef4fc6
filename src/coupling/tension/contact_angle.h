#pragma once
// Continues the level set behind walls and into solids so that the surface meets them at its contact angle.
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// phi (m), continued beyond walls and into solids, for curvature. It repeats the values inside, shifted along the wall
// towards the air by cot(angle) per unit of depth. The surface's mean slope over the wall is then that of the contact
// angle (after Sussman 2001; Afkhami, Bussmann 2008). Films that run along a wall continue along straight lines. Inside
// the flow phi is unchanged. Ghosts filled. Collective.
template <int Dim>
CellField<Dim> continue_at_contact_angle(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                         const StepGeometry<Dim>& geometry, const CellField<Dim>& phi);

}  // namespace seiche
