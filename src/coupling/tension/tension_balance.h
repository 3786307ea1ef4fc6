#pragma once
// Balance of surface tension on closed surfaces: it exerts no net force and no torque.
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Corrects kappa (1/m, on crossed faces) so that closed pieces of surface exert no net force and no torque. The
// integrals of kappa n and of r x kappa n over a closed surface are 0. Independently computed curvatures violate that
// by O(h^2), and no change of shape removes the error, so a drop at rest would start to move and turn. The correction
// is
//   kappa -= c.n + rho_f/rho n_f.(w x r),   n the unit normal, n_f that of the face out of the liquid,
// r from the piece's centre, c and w one vector each per connected piece, such that the sums of +-kappa e and of
// +-kappa r x e over the piece's links along e are 0. The part of w turns the links' fluid like a rigid body; one like
// a normal could not, for it has no torque on a circle. The pressure jump then conserves momentum and angular momentum
// to rounding. Pieces next to walls, solids or open sides, which may hold them, are left alone; the torque also of
// pieces that reach half-way round a periodic axis. Collective.
template <int Dim>
void balance_closed_pieces(const Domain<Dim>& domain, const Fluids& fluids, const FaceGeometry<Dim>& faces,
                           const CellField<Dim>& phi, const FaceField<Dim, char>& crossed, FaceField<Dim>& kappa);

}  // namespace seiche
