#include "coupling/drops/deposit.h"

#include <algorithm>

#include "fluid/volume/neighbours.h"
#include "fluid/volume/spill.h"
#include "grid/groups.h"

namespace seiche {
namespace {

// Liquid that cells have no room for, and the cells around that take it.
template <int Dim>
class Surplus {
 public:
  Surplus(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi, const CellField<Dim>& rest,
          const CellField<Dim>& share)
      : layout_(layout), room_(room), phi_(phi), rest_(rest), share_(share) {}

  // visit(neighbour, what it is offered)
  template <class Visit>
  void offer(Site cell, const Visit& visit) const {
    double all = 0;
    each_taker(cell, [&](Site n) { all += room_in(n); });
    if (all <= 0) return;
    const double part = std::min(rest_[cell], all) / all;
    each_taker(cell, [&](Site n) { visit(n, part * room_in(n)); });
  }
  double room_in(Site n) const { return std::max(0.0, room_.of(n) - share_[n]); }

 private:
  template <class Visit>
  void each_taker(Site cell, const Visit& visit) const {
    const IVec<Dim> index = layout_.index(cell);
    for (int k = 0; k < neighbour_count<Dim>(); ++k) {
      const IVec<Dim> o = neighbour_offset<Dim>(k);
      const Site n = cell + step_of(layout_, o);
      if (n != cell && phi_[n] < layout_.h() && lies_in_domain(layout_.geometry(), IVec<Dim>(index + o)) &&
          room_.joins(layout_, cell, o))
        visit(n);
    }
  }

  const Layout<Dim>& layout_;
  const Room<Dim>& room_;
  const CellField<Dim>&phi_, &rest_, &share_;
};

// Hands on what is left, `rest`, by the shares before; no cell takes more than it has room for.
template <int Dim>
void hand_around(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& phi,
                 const CellField<Dim>& rest, CellField<Dim>& share) {
  const CellField<Dim> before = share;
  const Surplus<Dim> surplus(layout, room, phi, rest, before);
  const std::vector<Site> cells = listed_possible(
      layout, cells_around(layout, 2), [&](Site c) { return !all_zero(rest.data() + c); },
      [&](Site c) { return rest[c] > 0; });
  CellField<Dim> offered(layout);
  for (const Site c : cells) surplus.offer(c, [&](Site n, double amount) { offered[n] += amount; });
  for (const Site c : cells) {
    if (!cells_around(layout, 1).contains(layout.index(c))) continue;
    double given = 0;
    surplus.offer(c, [&](Site n, double amount) {
      const double most = surplus.room_in(n), part = offered[n] > most ? amount * most / offered[n] : amount;
      share[n] += part;
      given += part;
    });
    share[c] += rest[c] - given;
  }
}

}  // namespace

template <int Dim>
void add_by_room(const Layout<Dim>& layout, const Halo<Dim>& halo, const Room<Dim>& room, const CellField<Dim>& phi,
                 const CellValues& volumes, CellField<Dim>& share) {
  CellField<Dim> rest(layout);
  for (const auto& [c, volume] : volumes) {
    const double own = std::min(volume, std::max(0.0, room.of(c) - share[c]));
    share[c] += own;
    rest[c] += volume - own;
  }
  fill_share_ghosts(layout, halo, share);
  halo.fill_ghosts(rest);
  hand_around(layout, room, phi, rest, share);
  fill_share_ghosts(layout, halo, share);
}

template <int Dim>
CellField<Dim> share_with_drops(const Layout<Dim>& layout, const Halo<Dim>& halo, const Drops<Dim>& drops,
                                CellField<Dim> share) {
  for (const Drop<Dim>& d : drops.list)
    share[layout.site(cell_around(layout.geometry(), d.place))] += d.volume / layout.geometry().cell_volume();
  fill_share_ghosts(layout, halo, share);
  return share;
}

#define SEICHE_INSTANTIATE(D)                                                                         \
  template void add_by_room<D>(const Layout<D>&, const Halo<D>&, const Room<D>&, const CellField<D>&, \
                               const CellValues&, CellField<D>&);                                     \
  template CellField<D> share_with_drops<D>(const Layout<D>&, const Halo<D>&, const Drops<D>&, CellField<D>);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
