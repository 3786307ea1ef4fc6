#pragma once
// Fullness of cells: a cell holds liquid up to its room K. Cells deep in the liquid have an excess, V - K, which the
// error of a solve has moved into them. It is not spilled, since no neighbour has room. The next solves push it out
// (ProjectionInput::missing_flux).
#include <type_traits>

#include "fluid/volume/room.h"
#include "grid/fields.h"
#include "grid/groups.h"

namespace seiche {

// Effect of a flow's divergence. `swells`: V grows by V dt div u, so that full cells stay full. `stays`: it is the
// error of a solve; V keeps it as the excess of deep cells.
enum class Divergence { swells, stays };

// Rules that decide how much liquid V a cell may hold: its capacity K (`room`), and the effect of divergence on V.
// `after`: the room once V has been carried; it is another where solids move.
template <int Dim>
struct LedgerRules {
  Divergence divergence;
  Room<Dim> room, after;

  LedgerRules(Divergence d, Room<Dim> r = {}) : LedgerRules(d, r, r) {}  // NOLINT: a Divergence alone will do
  LedgerRules(Divergence d, Room<Dim> r, Room<Dim> later) : divergence(d), room(r), after(later) {}
  LedgerRules at_end() const { return {divergence, after}; }
  bool has_moved() const { return room != after; }  // solids did
};
template <int Dim>
using Ledger = std::type_identity_t<LedgerRules<Dim>>;  // converts where Dim follows from other arguments

// True if the cell is full but for an excess: phi (m) knows no surface near it.
template <int Dim>
bool is_deep(const Layout<Dim>& layout, const Ledger<Dim>& ledger, const CellField<Dim>& phi,
             const CellField<Dim>& share, Site cell) {
  constexpr double depth = 1.2, lacking = 0.05;  // cells; share
  return ledger.divergence == Divergence::stays && phi[cell] < -depth * layout.h() &&
         share[cell] > ledger.room.of(cell) - lacking && ledger.room.of(cell) > 0;
}

// Volume fractions used for planes and swept regions: V/K, and 1 in deep cells. Where K <= 0.1, phi gives the fraction.
// Without solids V itself, K = 1.
template <int Dim>
class CountedShares {
 public:
  // phi (m) and share must be valid in the halo. Keeps references. `fed`: cells beyond the sides that are full.
  CountedShares(const Layout<Dim>& layout, const Ledger<Dim>& ledger, const CellField<Dim>& phi,
                const CellField<Dim>& share, const std::vector<Site>& fed = {});

  double operator[](Site c) const {
    if (!beside_.empty()) return beside_[c];
    const double v = share_[c];
    return v != 0 && v != 1 && is_deep(layout_, ledger_, phi_, share_, c) ? 1 : v;
  }
  // True if no cell of a group (grid/groups.h) counts.
  bool all_empty(Site first) const { return all_zero((beside_.empty() ? share_ : beside_).data() + first); }

 private:
  double beside_solids(Site cell) const;

  const Layout<Dim>& layout_;
  LedgerRules<Dim> ledger_;
  const CellField<Dim>&phi_, &share_;
  CellField<Dim> beside_;  // of all cells; empty: there are no solids
};

}  // namespace seiche
