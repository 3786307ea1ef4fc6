#pragma once
// Columns of J from the faces that a body closes.
#include "coupling/solids/cavity_volume.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// visit(cell, sign, n) of the cells with a row on both sides of each share n.
template <int Dim, class Visit>
void for_each_cell_of_shares(const Domain<Dim>& domain, const FaceShares& shares, const PressureRows<Dim>& rows,
                             const Visit& visit) {
  const Layout<Dim>& l = domain.layout;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const IVec<Dim> i = l.index(shares[n].face);
    IVec<Dim> low = i;
    low[shares[n].axis] -= 1;
    const Site behind = shares[n].face - l.stride(shares[n].axis);
    if (l.cells().contains(i) && rows.row[shares[n].face] >= 0) visit(shares[n].face, -1, n);
    if (l.cells().contains(low) && rows.row[behind] >= 0) visit(behind, 1, n);
  }
}

// Entries from `known` on that belong to regions of air, which may be rows of other ranks, go where their rows are, one
// a row and column. Collective.
template <int Dim>
void send_air_rows_to_owner(const Domain<Dim>& domain, const PressureRows<Dim>& rows, std::size_t known,
                            std::vector<FluxEntry>& entries);

void sort_by_rows(std::vector<FluxEntry>& entries);

// A block of sorted entries. Columns of unknowns of the other kind are left empty.
ColumnBlock make_block(const std::vector<FluxEntry>& entries, const std::vector<Freedom>& freedom, Freedom kind,
                       int first, int width);

// The block of body k if its unknowns, `first` and on, are the velocity of all of its surface. Collective.
template <int Dim>
ColumnBlock translation_columns(const CoupledStep<Dim>& step, int k, const std::vector<Freedom>& freedom, int first);

}  // namespace seiche
