#include "fluid/volume/spill.h"

#include "fluid/volume/moved_solids.h"
#include "fluid/volume/neighbours.h"
#include "grid/ghosts.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// A cell with more or less than it holds, and what its neighbours can take or give.
template <int Dim>
class Excess {
 public:
  Excess(const Layout<Dim>& layout, const Room<Dim>& room, const CellField<Dim>& share, Site cell, bool anywhere)
      : layout_(layout), room_(room), share_(share), cell_(cell), index_(layout.index(cell)), anywhere_(anywhere) {
    const double v = share[cell], most = room.of(cell);
    amount = v > most ? v - most : std::min(v, 0.0);
    each_neighbour([&](Site, double room) { total_ += room; });
  }
  double amount;  // beyond its room, or below 0
  double moved() const { return std::copysign(std::min(std::abs(amount), total_), amount); }

  // Room of a neighbour, or what it has to give. Cells with liquid take up more before empty ones do.
  double room_of(Site n) const {
    constexpr double wet = 1e-6;
    if (amount < 0) return std::max(0.0, share_[n]);
    return anywhere_ || share_[n] > wet ? std::max(0.0, room_.of(n) - share_[n]) : 0;
  }
  // visit(neighbour, what it is to get)
  template <class Visit>
  void hand_on(const Visit& visit) const {
    if (total_ <= 0) return;
    const double part = moved() / total_;
    each_neighbour([&](Site n, double room) { visit(n, part * room); });
  }

 private:
  template <class Visit>
  void each_neighbour(const Visit& visit) const {
    for (int n = 0; n < neighbour_count<Dim>(); ++n) {
      const IVec<Dim> o = neighbour_offset<Dim>(n);
      if (o.isZero() || !lies_in_domain(layout_.geometry(), IVec<Dim>(index_ + o))) continue;
      if (!room_.joins(layout_, cell_, o)) continue;
      const Site s = cell_ + step_of(layout_, o);
      if (const double room = room_of(s); room > 0) visit(s, room);
    }
  }

  const Layout<Dim>& layout_;
  const Room<Dim>& room_;
  const CellField<Dim>& share_;
  Site cell_;
  IVec<Dim> index_;
  bool anywhere_;
  double total_ = 0;
};

// True if a cell of the surface has so little beyond its room that the next solves push it out.
template <int Dim>
bool keeps_excess(const Layout<Dim>& layout, const Ledger<Dim>& ledger, const CellField<Dim>& phi,
                  const CellField<Dim>& share, Site c) {
  constexpr double little = 0.15, near = 0.5;  // share; cells
  const double room = ledger.room.of(c);
  return ledger.divergence == Divergence::stays && phi[c] < near * layout.h() && room > 0 && share[c] > 0 &&
         share[c] < room + little;
}

// Cells with more or less than they hold, but for what they keep.
template <int Dim>
std::vector<Site> cells_with_excess(const Layout<Dim>& layout, const CellField<Dim>& phi, const Ledger<Dim>& ledger,
                                    const CellField<Dim>& share) {
  constexpr double rounding = 1e-13;
  return listed_possible(
      layout, cells_around(layout, 2), [&](Site c) { return !all_zero(share.data() + c); },
      [&](Site c) {
        return (share[c] > ledger.room.of(c) + rounding || share[c] < -rounding) &&
               !is_deep(layout, ledger, phi, share, c) && !keeps_excess(layout, ledger, phi, share, c);
      });
}

// One round for the cells with excess. What this rank's cells gave. No cell gets or gives more than it can, however
// many neighbours ask: cells that took from the same one each as if alone made a rounding error grow 25-fold a round.
template <int Dim>
Spill hand_on_once(const Layout<Dim>& layout, const std::vector<Site>& cells, const Ledger<Dim>& ledger, bool anywhere,
                   CellField<Dim>& share) {
  const CellField<Dim> before = share;
  Spill spill;
  CellField<Dim> offered(layout), wanted(layout);
  for (const Site c : cells)
    Excess<Dim>(layout, ledger.room, before, c, anywhere).hand_on([&](Site n, double amount) {
      (amount > 0 ? offered : wanted)[n] += std::abs(amount);
    });
  const Box<Dim> owned = layout.cells(), near = cells_around(layout, 1);
  for (const Site c : cells) {
    if (!near.contains(layout.index(c))) continue;
    const Excess<Dim> excess(layout, ledger.room, before, c, anywhere);
    double moved = 0;
    excess.hand_on([&](Site n, double amount) {
      const double all = (amount > 0 ? offered : wanted)[n], room = excess.room_of(n);
      const double part = all > room ? amount * room / all : amount;
      share[n] += part;
      moved += part;
    });
    share[c] -= moved;
    if (!owned.contains(layout.index(c))) continue;
    spill.moved += std::abs(moved);
    spill.worst = std::max(spill.worst, std::abs(excess.amount));
  }
  return spill;
}

// Cells with little room beside solids hand what is beyond it to their hosts, which may have to spill it.
template <int Dim>
void hand_to_hosts(const Layout<Dim>& layout, const Halo<Dim>& halo, const Room<Dim>& room, CellField<Dim>& share) {
  constexpr int rounds = 3;  // a host may have a host
  if (room.is_whole()) return;
  for (int round = 0; round < rounds; ++round) {
    const CellField<Dim> before = share;
    room.each_with_host(layout, cells_around(layout, 1), [&](Site c, Site host) {
      const double beyond = before[c] - std::clamp(before[c], 0.0, room.of(c));
      share[host] += beyond;
      share[c] -= beyond;
    });
    fill_share_ghosts(layout, halo, share);
  }
}

}  // namespace

template <int Dim>
void fill_share_ghosts(const Layout<Dim>& layout, const Halo<Dim>& halo, CellField<Dim>& share) {
  halo.fill_ghosts(share);
  extend_beyond_sides<Dim>(layout, share.data(), cell_offset<Dim>(), all_sides<Dim>(Extension::constant));
}

template <int Dim>
Spill hand_on_excess(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                     const CellField<Dim>& phi, const Ledger<Dim>& ledger, const RoomChange<Dim>& change,
                     CellField<Dim>& share) {
  Spill all;
  if (ledger.has_moved()) follow_moved_solids(layout, halo, phi, ledger, change, share);
  const LedgerRules<Dim> present = ledger.at_end();
  hand_to_hosts(layout, halo, present.room, share);
  for (int round = 0; round < 3; ++round) {
    const std::vector<Site> cells = cells_with_excess(layout, phi, present, share);
    if (!ranks.any(!cells.empty())) break;
    const Spill spill = hand_on_once(layout, cells, present, round > 0, share);
    all.moved += ranks.global_sum(spill.moved);
    if (round == 0) all.worst = ranks.global_max(spill.worst);
    fill_share_ghosts(layout, halo, share);
  }
  return all;
}

#define SEICHE_INSTANTIATE(D)                                                                                  \
  template Spill hand_on_excess<D>(const Layout<D>&, const Halo<D>&, const Communicator&, const CellField<D>&, \
                                   const Ledger<D>&, const RoomChange<D>&, CellField<D>&);                     \
  template void fill_share_ghosts<D>(const Layout<D>&, const Halo<D>&, CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
