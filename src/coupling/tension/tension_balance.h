#pragma once
// Balance of surface tension on closed surfaces: it exerts no net force.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Corrects kappa (1/m, on crossed faces) so that closed pieces of surface exert no net force. The integral of kappa n
// over a closed surface is 0. Independently computed curvatures violate that by O(h^2), and no change of shape removes
// the error, so a drop at rest would start to move. The correction is
//   kappa -= c.n,   n the unit normal, c one vector per connected piece,
// such that the sum of +-kappa over the piece's links along each axis is 0. Its pressure jump then conserves momentum
// to rounding. Pieces next to walls, solids or open sides, which may hold them, are left alone. Collective.
template <int Dim>
void balance_closed_pieces(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& phi,
                           const FaceField<Dim, char>& crossed, FaceField<Dim>& kappa);

}  // namespace seiche
