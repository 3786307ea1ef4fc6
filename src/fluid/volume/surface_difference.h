#pragma once
// Difference of the volumes of liquid and the level set, in the cells of the surface.
#include <algorithm>
#include <vector>

#include "fluid/volume/ledger.h"
#include "fluid/volume/neighbours.h"
#include "grid/fields.h"
#include "grid/halo.h"

namespace seiche {

// The surface's area in each cell, A = dV_phi/d(shift) (cells), and the difference of volume and level set, D = V -
// V_phi.
template <int Dim>
struct Difference {
  CellField<Dim> area, missing;
  Room<Dim> room;

  // phi (m) and the shares of liquid must be valid in the halo; psi (m): of the solids. Deep cells do not differ.
  Difference(const Layout<Dim>& layout, const NodeField<Dim>& psi, const CellField<Dim>& phi, const Ledger<Dim>& ledger,
             const CellField<Dim>& share);
  bool on_surface(Site c) const;
};

// Length, in cells, over which a difference is spread along the surface.
constexpr double filter_length = 3;

// Links of surface cells with those around: w = l^2 min(A_c, A_n)/|distance|^2.
template <int Dim, class Visit>
void visit_links(const Layout<Dim>& layout, const Difference<Dim>& d, Site c, const Visit& visit) {
  for (int n = 0; n < neighbour_count<Dim>(); ++n) {
    const IVec<Dim> o = neighbour_offset<Dim>(n);
    const Site m = c + step_of(layout, o);
    if (m == c || !d.on_surface(m) || !d.room.joins(layout, c, o)) continue;
    visit(m, filter_length * filter_length * std::min(d.area[c], d.area[m]) / o.squaredNorm());
  }
}

// delta with (A - l^2 Laplacian along the surface) delta = rhs on the surface's cells, in cells. A fixed number of
// Chebyshev steps for the spectrum [1/90, 2] of the matrix scaled by its diagonal: no sums over ranks. Collective.
template <int Dim>
CellField<Dim> smooth_shift(const Layout<Dim>& layout, const Halo<Dim>& halo, const Difference<Dim>& d,
                            const std::vector<Site>& surface, const CellField<Dim>& rhs);

}  // namespace seiche
