#include "fluid/volume/ledger.h"

#include "fluid/volume/neighbours.h"
#include "grid/ghosts.h"
#include "levelset/fractions.h"

namespace seiche {

template <int Dim>
CountedShares<Dim>::CountedShares(const Layout<Dim>& layout, const Ledger<Dim>& ledger, const CellField<Dim>& phi,
                                  const CellField<Dim>& share, const std::vector<Site>& fed)
    : layout_(layout), ledger_(ledger), phi_(phi), share_(share) {
  if (ledger.room.is_whole()) return;
  CellField<Dim> counted = share;
  for_each_site(layout, cells_around(layout, layout.halo() - 1), [&](Site c) { counted[c] = beside_solids(c); });
  extend_beyond_sides<Dim>(layout, counted.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::constant));
  for (const Site c : fed) counted[c] = 1;
  beside_ = std::move(counted);
}

// V/K. Where a cell has little room or none, phi is continued into the solid, and tells how full it would be.
template <int Dim>
double CountedShares<Dim>::beside_solids(Site c) const {
  constexpr double little = 0.1;
  const double room = ledger_.room.of(c);
  if (is_deep(layout_, ledger_, phi_, share_, c)) return 1;
  return room > little ? share_[c] / room : liquid_share(layout_, phi_, c);
}

template class CountedShares<2>;
template class CountedShares<3>;

}  // namespace seiche
