#pragma once
// Columns of J from the faces that a body closes.
#include "coupling/solids/cavity_volume.h"
#include "fluid/boundary/domain.h"

namespace seiche {

// Calls visit(cell, sign, n) for each share n and each owned cell beside its face with counts(cell). sign is 1 for the
// cell below the face, -1 for the cell above.
template <int Dim, class Counts, class Visit>
void for_each_cell_of_shares(const Domain<Dim>& domain, const FaceShares& shares, const Counts& counts,
                             const Visit& visit) {
  const Layout<Dim>& l = domain.layout;
  for (std::size_t n = 0; n < shares.size(); ++n) {
    const IVec<Dim> i = l.index(shares[n].face);
    IVec<Dim> low = i;
    low[shares[n].axis] -= 1;
    const Site behind = shares[n].face - l.stride(shares[n].axis);
    if (l.cells().contains(i) && counts(shares[n].face)) visit(shares[n].face, -1, n);
    if (l.cells().contains(low) && counts(behind)) visit(behind, 1, n);
  }
}

// Tells cells with a row.
template <int Dim>
auto with_row(const PressureRows<Dim>& rows) {
  return [&rows](Site cell) { return rows.row[cell] >= 0; };
}

// Moves the entries of enclosed air, from index `known` on, to the ranks that have their rows. Entries of one row and
// column are added; sums within round-off are dropped. Collective.
template <int Dim>
void send_air_rows_to_owner(const Domain<Dim>& domain, const PressureRows<Dim>& rows, std::size_t known,
                            std::vector<FluxEntry>& entries);

void sort_by_rows(std::vector<FluxEntry>& entries);

// Column block of sorted entries; those of one row and column are added. Fills only columns of unknowns of this kind.
ColumnBlock make_block(const std::vector<FluxEntry>& entries, const std::vector<Freedom>& freedom, Freedom kind,
                       int first, int width);

// Column block of body k if its Dim unknowns, from `first` on, are the velocity of its whole surface. Collective.
template <int Dim>
ColumnBlock translation_columns(const CoupledStep<Dim>& step, int k, const std::vector<Freedom>& freedom, int first);

}  // namespace seiche
