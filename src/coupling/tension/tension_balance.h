#pragma once
// A closed surface pulls itself nowhere.
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// The sum of kappa n over a closed surface is 0; that of curvatures found one by one is not, by their error of order
// h^2, and no change of shape would make it so: a drop at rest would set out on its own. kappa (1/m, on crossed faces)
// is shifted by c.n, n the normal there, c one vector for each connected piece of the surface, so that the sum over the
// piece's links along each axis of +-kappa is 0: its pressure jump keeps the momentum to rounding. Pieces next to
// walls, solids or open sides, where others hold them, stay as they are. Collective.
template <int Dim>
void balance_closed_pieces(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const CellField<Dim>& phi,
                           const FaceField<Dim, char>& crossed, FaceField<Dim>& kappa);

}  // namespace seiche
