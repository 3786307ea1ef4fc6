#pragma once
// Loads on static and prescribed solids by pieces of their surface.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"

namespace seiche {

// The load on each solid beyond pressure_loads(); zero for solids that forces move and for thin ones. Faces of the grid
// have the pressure of a cell's centre, up to half a cell from the surface. With p(x) = p_c + rho g.(x - x_c) near a
// cell c, rho of its fluid, down to 0 at the surface of liquid, the load is -int p n dA over pieces of the solid's
// surface. It is exact for liquid at rest (docs/decisions/0064-loads-on-floating-bodies.md). Where one fluid surrounds
// a solid, the load is that on faces and what these miss of p = rho g.x. Torques as in pressure_loads(). Collective.
template <int Dim>
std::vector<SolidLoad> loads_beyond_faces(const Setup<Dim>& setup, const StepGeometry<Dim>& geometry,
                                          const State<Dim>& state);

// Pieces of the surfaces of static solids that no other static solid covers, fixed for the run. One list a solid; empty
// for others.
template <int Dim>
std::vector<std::vector<PlacedPiece<Dim>>> pieces_of_still_solids(const Domain<Dim>& domain,
                                                                  const std::vector<Body<Dim>>& bodies);

}  // namespace seiche
