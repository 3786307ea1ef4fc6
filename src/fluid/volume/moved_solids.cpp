#include "fluid/volume/moved_solids.h"

#include <algorithm>
#include <optional>

#include "fluid/volume/neighbours.h"
#include "fluid/volume/spill.h"
#include "grid/groups.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Neighbour with the most room `after` that open faces joined before to a cell which a solid has covered since.
template <int Dim>
std::optional<Site> host_of_covered(const Layout<Dim>& layout, const Ledger<Dim>& ledger, Site cell) {
  std::optional<Site> host;
  double most = 0;
  for (int n = 0; n < neighbour_count<Dim>(); ++n) {
    const IVec<Dim> o = neighbour_offset<Dim>(n);
    const Site next = cell + step_of(layout, o);
    const double room = ledger.after.of(next);
    if (!(room > most) || !lies_in_domain(layout.geometry(), IVec<Dim>(layout.index(cell) + o))) continue;
    if (ledger.room.joins(layout, cell, o)) most = room, host = next;
  }
  return host;
}

// Moves the liquid of covered cells to their hosts.
template <int Dim>
void leave_covered(const Layout<Dim>& layout, const Halo<Dim>& halo, const Ledger<Dim>& ledger, CellField<Dim>& share) {
  const CellField<Dim> before = share;
  const std::vector<Site> covered = listed_possible(
      layout, cells_around(layout, 1), [&](Site c) { return !all_zero(before.data() + c); },
      [&](Site c) { return before[c] != 0 && ledger.after.of(c) == 0; });
  for (const Site c : covered)
    if (const std::optional<Site> host = host_of_covered(layout, ledger, c)) {
      share[*host] += before[c];
      share[c] -= before[c];
    }
  fill_share_ghosts(layout, halo, share);
}

// Full cells within two of those whose room changed: deep in the liquid, or full as far as V tells. A surface may pass
// some of the latter, which lack liquid rightly: `lack`, (K - V)/K before the step, at least 0.
template <int Dim>
struct FullCells {
  CellField<Dim, char> full;
  CellField<Dim> lack;

  FullCells(const Layout<Dim>& layout, const CellField<Dim>& phi, const Ledger<Dim>& ledger,
            const CellField<Dim>& before, const CellField<Dim>& share)
      : full(layout), lack(layout) {
    constexpr double depth = 1.2;  // cells, as for is_deep()
    constexpr double least = 0.9;  // share of the room
    constexpr int reach = 2;
    CellField<Dim, char> changed(layout);
    const Box<Dim> box = cells_around(layout, reach + 1);
    std::vector<Site> sites;
    const auto look = [&](Site c, double) {
      if (ledger.room.of(c) != ledger.after.of(c) && box.contains(layout.index(c))) sites.push_back(c);
    };
    ledger.room.each_stored(look), ledger.after.each_stored(look);
    mark_around(layout, sites, reach, changed);
    for_each_marked(layout, cells_around(layout, 1), changed.data(), [&](Site c) {
      const double room = ledger.after.of(c), was = ledger.room.of(c);
      const bool deep = phi[c] < -depth * layout.h();
      full[c] = room > 0 && (deep || (phi[c] < 0 && share[c] > least * room));
      if (full[c] && !deep && was > 0) lack[c] = std::max(0.0, 1 - before[c] / was);
    });
  }
};

// Jacobi steps of a diffusion: dV_c = sum over open faces of k (e_n - e_c), k = min(K_c, K_n)/(2 Dim). e: the excess
// (V - K)/K where positive, else what the cell lacks more than before the step.
template <int Dim>
void even_out_excess(const Layout<Dim>& layout, const Halo<Dim>& halo, const Room<Dim>& room,
                     const FullCells<Dim>& near, CellField<Dim>& share) {
  constexpr int steps = 10;
  const auto excess = [&](Site c) {
    const double e = (share[c] - room.of(c)) / room.of(c);
    return e > 0 ? e : std::min(0.0, e + near.lack[c]);
  };
  const std::vector<Site> cells = listed_possible(
      layout, layout.cells(), [&](Site c) { return any_marked(near.full.data() + c); },
      [&](Site c) { return near.full[c] != 0; });
  std::vector<double> change(cells.size());
  for (int n = 0; n < steps; ++n) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Site c = cells[k];
      double sum = 0;
      for (int a = 0; a < Dim; ++a)
        for (const Site m : {c - layout.stride(a), c + layout.stride(a)})
          if (near.full[m] && room.through(a, std::max(c, m)) > 0)
            sum += std::min(room.of(c), room.of(m)) / (2 * Dim) * (excess(m) - excess(c));
      change[k] = sum;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) share[cells[k]] += change[k];
    halo.fill_ghosts(share);
  }
}

}  // namespace

template <int Dim>
void follow_moved_solids(const Layout<Dim>& layout, const Halo<Dim>& halo, const CellField<Dim>& phi,
                         const Ledger<Dim>& ledger, const CellField<Dim>& before, CellField<Dim>& share) {
  leave_covered(layout, halo, ledger, share);
  even_out_excess(layout, halo, ledger.after, FullCells<Dim>(layout, phi, ledger, before, share), share);
  fill_share_ghosts(layout, halo, share);
}

template void follow_moved_solids<2>(const Layout<2>&, const Halo<2>&, const CellField<2>&, const Ledger<2>&,
                                     const CellField<2>&, CellField<2>&);
template void follow_moved_solids<3>(const Layout<3>&, const Halo<3>&, const CellField<3>&, const Ledger<3>&,
                                     const CellField<3>&, CellField<3>&);

}  // namespace seiche
