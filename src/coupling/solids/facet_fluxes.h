#pragma once
// Pressure of each cell on the facets of an elastic body within it.
#include "coupling/solids/cavity_volume.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "solid/elastic/side_loads.h"

namespace seiche {

// A piece of a body's surface and the cell whose pressure acts on it (ExposedPiece).
template <int Dim>
struct LoadedPiece {
  Site cell;
  SideLoad<Dim> load;
};

// J of one elastic body, per face area, over this rank's cells:
//   (J v)_c = F + D,   F = -1/A sum over the pieces of c of int v.n dA.
// F exerts each cell's pressure as the traction -p n on the body's own mesh. A constant pressure is then in equilibrium
// to round-off. D makes the flux of a translation that of the body's face shares,
//   sum_n (F + D)_cn = sum_f +- s_f,
// which conserves momentum and keeps rest. D has the least sum of squares with sum_c D_cn = 0 at nodes that are not
// pinned. A constant pressure then exerts no load by D on these nodes.
template <int Dim>
struct FacetFluxes {
  std::vector<LoadedPiece<Dim>> pieces;
  CellFluxes balance;  // D
};

// Facet fluxes of body k at nodal displacements u. `open`: open_cells(). Collective.
template <int Dim>
FacetFluxes<Dim> facet_fluxes(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& geometry,
                              const CellField<Dim, char>& open, int k, const Eigen::VectorXd& u);

// F + D as entries of this rank's cells.
template <int Dim>
CellFluxes entries_of(const Domain<Dim>& domain, const FacetFluxes<Dim>& fluxes);

// Nodal forces (N) that make buoyancy exact. Pressures are values at cell centres, while the surface lies beside them.
// The pressure rho g.x of liquid at rest exerts on the wet pieces the load
//   -int rho g.x n N_i dA.
// J'p gives this with x_c for x, plus a term of D. Returns the difference, so that bodies at rest feel the exact load
// on their mesh, rho g V in total. Gas counts by its density. Collective.
template <int Dim>
Eigen::VectorXd missing_buoyancy(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                 const PressureRows<Dim>& rows, const CellField<Dim>& phi, int k,
                                 const Eigen::VectorXd& u, const FacetFluxes<Dim>& fluxes, const Vec<Dim>& gravity);

}  // namespace seiche
