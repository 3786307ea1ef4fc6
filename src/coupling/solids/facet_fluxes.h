#pragma once
// How the pressure of each cell acts on the facets of an elastic body that lie in it.
#include "coupling/solids/cavity_volume.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "solid/elastic/side_loads.h"

namespace seiche {

// A piece of a body's surface and the cell whose pressure acts on it. That is the cell it lies in, or, where nothing
// of that one is open, the next one along the normal.
template <int Dim>
struct LoadedPiece {
  Site cell;
  SideLoad<Dim> load;
};

// J of one elastic body, per face area, over this rank's cells:
//   (J v)_c = F + D,   F = -1/A sum over the pieces of c of int v.n dA.
// F alone gives the body the traction -p n of each cell's pressure on its own mesh, so that a constant pressure is in
// equilibrium with itself to rounding. D makes a translation push what the body's face shares show,
//   sum_n (F + D)_cn = sum_f +- s_f,
// which keeps momentum and rest. It is the least change in the sum of squares that leaves what a constant pressure does
// to each node that is not pinned, sum_c D_cn = 0.
template <int Dim>
struct FacetFluxes {
  std::vector<LoadedPiece<Dim>> pieces;
  CellFluxes balance;  // D
};

// The cells with a face whose velocity is an unknown, ghosts filled. Collective.
template <int Dim>
CellField<Dim, char> open_cells(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces);

// Of body k with the displacement u. Collective.
template <int Dim>
FacetFluxes<Dim> facet_fluxes(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& geometry,
                              const CellField<Dim, char>& open, int k, const Eigen::VectorXd& u);

// J as entries of the cells with a row, this rank's or regions of air.
template <int Dim>
std::vector<FluxEntry> entries_of(const Domain<Dim>& domain, const PressureRows<Dim>& rows,
                                  const FacetFluxes<Dim>& fluxes);

// Forces on the nodes, N. Pressures are those at the centres of cells, while the surface lies beside them. For the
// pressure rho g.x of liquid at rest the traction on the wet pieces is
//   -int rho g.x n N_i dA,
// and J'p gives that with x_c for x, and D. This is the difference, so that bodies at rest feel what their mesh
// should, rho g V in all. Gas counts by its density. Collective.
template <int Dim>
Eigen::VectorXd missing_buoyancy(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                 const PressureRows<Dim>& rows, const CellField<Dim>& phi, int k,
                                 const Eigen::VectorXd& u, const FacetFluxes<Dim>& fluxes, const Vec<Dim>& gravity);

}  // namespace seiche
