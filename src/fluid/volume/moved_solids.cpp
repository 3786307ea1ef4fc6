#include "fluid/volume/moved_solids.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fluid/volume/neighbours.h"
#include "fluid/volume/spill.h"
#include "grid/groups.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Neighbours of a cell that a solid has covered since, those with the most room `after` among the ones that open faces
// joined to it. A front that passes a face in the middle of the step has closed it: if none is joined, those beside it
// that had room before count.
template <int Dim>
std::vector<Site> hosts_of_covered(const Layout<Dim>& layout, const Ledger<Dim>& ledger, Site cell) {
  constexpr double equal = 1e-9;  // so that mirror images have mirrored hosts
  std::vector<Site> hosts;
  double most = 0;
  const auto find = [&](const auto& counts) {
    for (int n = 0; n < neighbour_count<Dim>(); ++n) {
      const IVec<Dim> o = neighbour_offset<Dim>(n);
      const Site next = cell + step_of(layout, o);
      const double room = ledger.after.of(next);
      if (room == 0 || room <= most - equal || !counts(o, next)) continue;
      if (!lies_in_domain(layout.geometry(), IVec<Dim>(layout.index(cell) + o))) continue;
      if (room > most + equal) hosts.clear();
      most = std::max(most, room);
      hosts.push_back(next);
    }
  };
  find([&](const IVec<Dim>& o, Site) { return ledger.room.joins(layout, cell, o); });
  if (hosts.empty())
    find([&](const IVec<Dim>& o, Site next) { return o.squaredNorm() == 1 && ledger.room.of(next) > 0; });
  return hosts;
}

// Moves the liquid of covered cells to their hosts, in equal parts.
template <int Dim>
void leave_covered(const Layout<Dim>& layout, const Halo<Dim>& halo, const Ledger<Dim>& ledger, CellField<Dim>& share) {
  const CellField<Dim> before = share;
  const std::vector<Site> covered = listed_possible(
      layout, cells_around(layout, 1), [&](Site c) { return !all_zero(before.data() + c); },
      [&](Site c) { return before[c] != 0 && ledger.after.of(c) == 0; });
  for (const Site c : covered) {
    const std::vector<Site> hosts = hosts_of_covered(layout, ledger, c);
    for (const Site host : hosts) share[host] += before[c] / double(hosts.size());
    if (!hosts.empty()) share[c] -= before[c];
  }
  fill_share_ghosts(layout, halo, share);
}

// 1 on the cells within two of those whose room changed, among the owned ones and two beyond.
template <int Dim>
CellField<Dim, char> cells_near_changes(const Layout<Dim>& layout, const Ledger<Dim>& ledger) {
  constexpr int reach = 2;
  constexpr double rounding = 1e-9;  // share of a cell: what the solver's tolerance moves a solid at rest by
  CellField<Dim, char> near(layout);
  const Box<Dim> box = cells_around(layout, reach + 1);
  std::vector<Site> sites;
  const auto look = [&](Site c, double) {
    if (std::abs(ledger.room.of(c) - ledger.after.of(c)) > rounding && box.contains(layout.index(c)))
      sites.push_back(c);
  };
  ledger.room.each_stored(look), ledger.after.each_stored(look);
  mark_around(layout, sites, reach, near);
  return near;
}

// Liquid cells near solids that moved, and what they hold where nothing is out of place: K deep in the liquid, where
// all excess is, else V less the liquid's part of the mismatch m, V m/(K' + m), and no more than K.
template <int Dim>
struct PressedCells {
  CellField<Dim, char> among;
  CellField<Dim> due;

  PressedCells(const Layout<Dim>& layout, const CellField<Dim>& phi, const Ledger<Dim>& ledger,
               const RoomChange<Dim>& change, const CellField<Dim>& share)
      : among(layout), due(layout) {
    constexpr double depth = 1.2;  // cells, as for is_deep()
    for_each_marked(layout, cells_around(layout, 1), change.near.data(), [&](Site c) {
      const double room = ledger.after.of(c), m = change.mismatch[c], came = room + m;
      if (!(room > 0) || !(phi[c] < 0)) return;
      among[c] = 1;
      const double fullness = came > 0 ? std::clamp(share[c] / came, 0.0, 1.0) : 0;
      due[c] = phi[c] < -depth * layout.h() ? room : std::min(room, share[c] - fullness * m);
    });
  }
};

// Brings e, what cells have beyond their due over K, near to its mean: dV_c = -(A e)_c, the sum over open faces of
// k (e_n - e_c), k = min(K_c, K_n)/(2 Dim). A/K has eigenvalues in [0, 2]. Chebyshev steps (Saad 2003, algorithm 12.1)
// reduce those above `slowest`, waves shorter than some twenty cells, by 1/T_n(theta/delta) = 1/60.
template <int Dim>
void even_out_excess(const Layout<Dim>& layout, const Halo<Dim>& halo, const Room<Dim>& room,
                     const PressedCells<Dim>& near, CellField<Dim>& share) {
  constexpr int steps = 24;
  constexpr double slowest = 0.02, theta = (2 + slowest) / 2, delta = (2 - slowest) / 2;
  const auto excess = [&](Site c) { return (share[c] - near.due[c]) / room.of(c); };
  const std::vector<Site> cells = listed_possible(
      layout, layout.cells(), [&](Site c) { return any_marked(near.among.data() + c); },
      [&](Site c) { return near.among[c] != 0; });
  std::vector<double> change(cells.size());
  double rho = delta / theta;
  for (int n = 0; n < steps; ++n) {
    const double next = n == 0 ? rho : 1 / (2 * theta / delta - rho);
    const double kept = n == 0 ? 0 : next * rho, taken = n == 0 ? 1 / theta : 2 * next / delta;
    rho = next;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Site c = cells[k];
      double sum = 0;
      for (int a = 0; a < Dim; ++a)
        for (const Site m : {c - layout.stride(a), c + layout.stride(a)})
          if (near.among[m] && room.through(a, std::max(c, m)) > 0)
            sum += std::min(room.of(c), room.of(m)) / (2 * Dim) * (excess(m) - excess(c));
      change[k] = kept * change[k] + taken * sum;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) share[cells[k]] += change[k];
    halo.fill_ghosts(share);
  }
}

}  // namespace

template <int Dim>
RoomChange<Dim> change_of_room(const Layout<Dim>& layout, const Ledger<Dim>& ledger, const FaceField<Dim>& u,
                               double dt) {
  RoomChange<Dim> change{cells_near_changes(layout, ledger), CellField<Dim>(layout)};
  for_each_marked(layout, cells_around(layout, 1), change.near.data(), [&](Site c) {
    double in = 0;
    for (int a = 0; a < Dim; ++a) {
      const Site high = c + layout.stride(a);
      in += ledger.room.through(a, c) * u.at(a, c) - ledger.room.through(a, high) * u.at(a, high);
    }
    change.mismatch[c] = ledger.room.of(c) + dt / layout.h() * in - ledger.after.of(c);
  });
  return change;
}

template <int Dim>
void follow_moved_solids(const Layout<Dim>& layout, const Halo<Dim>& halo, const CellField<Dim>& phi,
                         const Ledger<Dim>& ledger, const RoomChange<Dim>& change, CellField<Dim>& share) {
  const PressedCells<Dim> pressed(layout, phi, ledger, change, share);
  leave_covered(layout, halo, ledger, share);
  even_out_excess(layout, halo, ledger.after, pressed, share);
  fill_share_ghosts(layout, halo, share);
}

#define SEICHE_INSTANTIATE(D)                                                                                   \
  template RoomChange<D> change_of_room<D>(const Layout<D>&, const Ledger<D>&, const FaceField<D>&, double);    \
  template void follow_moved_solids<D>(const Layout<D>&, const Halo<D>&, const CellField<D>&, const Ledger<D>&, \
                                       const RoomChange<D>&, CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
