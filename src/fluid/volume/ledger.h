#pragma once
// The excess of cells deep in the liquid: what the error of a solve has moved into them, V - 1. It is not spilled,
// since no neighbour has room. The next solves push it out (ProjectionInput::missing_flux).
#include "grid/fields.h"
#include "grid/groups.h"

namespace seiche {

// Effect of a flow's divergence. `swells`: V grows by V dt div u, so that full cells stay full. `stays`: it is the
// error of a solve; V keeps it as the excess of deep cells.
enum class Divergence { swells, stays };

// True if the cell is full but for an excess: phi (m) knows no surface near it.
template <int Dim>
bool is_deep(const Layout<Dim>& layout, Divergence divergence, const CellField<Dim>& phi, const CellField<Dim>& share,
             Site cell) {
  constexpr double depth = 1.2, least = 0.95;  // cells; share
  return divergence == Divergence::stays && phi[cell] < -depth * layout.h() && share[cell] > least;
}

// Shares that count for planes and regions: deep cells are full.
template <int Dim>
class CountedShares {
 public:
  CountedShares(const Layout<Dim>& layout, Divergence divergence, const CellField<Dim>& phi,
                const CellField<Dim>& share)
      : layout_(layout), divergence_(divergence), phi_(phi), share_(share) {}

  double operator[](Site c) const {
    const double v = share_[c];
    return v != 0 && v != 1 && is_deep(layout_, divergence_, phi_, share_, c) ? 1 : v;
  }
  // True if the cells of a group (grid/groups.h) are empty.
  bool all_empty(Site first) const { return all_zero(share_.data() + first); }

 private:
  const Layout<Dim>& layout_;
  Divergence divergence_;
  const CellField<Dim>&phi_, &share_;
};

}  // namespace seiche
