#pragma once
// Solids that no fluid surrounds: placed, but not measured on the grid.
#include "coupling/geometry/step_geometry.h"

namespace seiche {

// Placements at the solve and nothing else: all faces are open, no solid has a share, and psi is empty. For solids that
// do not deform.
template <int Dim>
StepGeometry<Dim> place_off_grid(const Layout<Dim>& layout, const std::vector<Body<Dim>>& bodies,
                                 std::vector<Placement> placed);

}  // namespace seiche
