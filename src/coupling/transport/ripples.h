#pragma once
// Ripples of the waterline at walls between two levels.
#include "base/gravity.h"
#include "coupling/geometry/step_geometry.h"
#include "coupling/state/state.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Brakes slow ripples near the surface and within three cells of closed ones (cells_to_continue()): u_star (m/s) after
// transport, on faces that liquid crosses by less than a tenth of a cell in the step dt (s). Transport and pressure are
// not each other's adjoint where cut cells meet a waterline, so that ripples of some two cells may grow by a few tenths
// a second (docs/decisions/0029-level-set-in-static-solids.md). Collective.
template <int Dim>
void brake_ripples(const Domain<Dim>& domain, const Gravity& gravity, const State<Dim>& before,
                   const StepGeometry<Dim>& geometry, const CellField<Dim, char>& closed, const CellField<Dim>& phi,
                   double dt, FaceField<Dim>& u_star);

}  // namespace seiche
