#pragma once
// Velocity that transport reads within no-slip solids (docs/decisions/0067-flow-through-walls.md).
#include "coupling/transport/no_slip_solids.h"

namespace seiche {

// Continues u (m/s) into the solids. With u' = u - solid, the depth y below the surface (cells) and u' at 1 and 3/2
// cells outside: the tangential part is the parabola through 0 at the surface and both values; the normal part is
// u'_n(1) y^2, since it goes as the square of the distance. Ghosts filled. Collective.
template <int Dim>
void continue_through_walls(const Domain<Dim>& domain, const NoSlipSolids<Dim>& solids, FaceField<Dim>& u);

}  // namespace seiche
