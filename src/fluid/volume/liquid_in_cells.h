#pragma once
// The liquid as a set: full and empty cells, and planes in mixed ones.
#include <optional>

#include "fluid/volume/grid_pieces.h"
#include "fluid/volume/surface_pieces.h"
#include "fluid/volume/swept_region.h"
#include "levelset/fractions.h"

namespace seiche {

// Known on this rank's cells and in their halo but its two outer layers.
template <int Dim>
class LiquidInCells {
 public:
  // quick: one plane may stand for the surface in a whole region, see flat_cell().
  LiquidInCells(const Layout<Dim>& layout, const CellField<Dim>& phi, const CountedShares<Dim>& share, bool quick)
      : layout_(layout),
        share_(share),
        pieces_(surface_pieces(layout, layout.grown(layout.halo() - 2), phi, share)),
        quick_(quick) {}

  // 0 or 1 if all cells of a range are empty or full, else -1.
  int uniform(const CellRange<Dim>& range) const {
    bool full = true, empty = true;
    each_cell(range, [&](const IVec<Dim>& i) {
      const double v = share_[layout_.site(i)];
      full = full && v >= 1 - least_share;
      empty = empty && v <= least_share;
      return full || empty;
    });
    return full ? 1 : empty ? 0 : -1;
  }
  // Liquid in a region, in cells.
  double within(const SweptRegion<Dim>& region) const {
    const int value = uniform(region.range());
    if (value >= 0) return value * region.measure();
    double sum = 0;
    if (const std::optional<IVec<Dim>> cell = quick_ ? flat_cell(region) : std::nullopt)
      for (const Simplex<Dim>& s : region) sum += below_plane(*cell, s);
    else
      for (const Simplex<Dim>& s : region) sum += within(s);
    return sum;
  }
  // Liquid in a simplex, with its sign, in cells.
  double within(const Simplex<Dim>& s) const {
    double sum = 0;
    const auto uniform_range = [&](const CellRange<Dim>& range, const Simplex<Dim>& piece) {
      const int value = uniform(range);
      if (value == 1) sum += piece.measure;
      return value >= 0;
    };
    visit_cells(s, uniform_range,
                [&](const IVec<Dim>& cell, const Simplex<Dim>& piece) { sum += below_plane(cell, piece); });
    return sum;
  }

 private:
  // Calls visit(cell) for the cells of a range until it returns false; false if it did.
  template <class Visit>
  static bool each_cell(const CellRange<Dim>& range, const Visit& visit) {
    IVec<Dim> i = range.lower;
    for (;;) {
      if (!visit(i)) return false;
      int a = 0;
      while (a < Dim && ++i[a] > range.upper[a]) i[a] = range.lower[a], ++a;
      if (a == Dim) return true;
    }
  }
  static Vec<Dim> centre_of(const IVec<Dim>& cell) { return cell.template cast<double>().array() + 0.5; }

  // A cell whose plane stands for the surface in all cells that a region reaches, to 0.01 of each: the mixed one
  // nearest to its middle; none if the surface bends.
  std::optional<IVec<Dim>> flat_cell(const SweptRegion<Dim>& region) const {
    // Ties, which rounding must not break: the nearest to half full counts, then the first.
    constexpr double most = 0.01, tie = 1e-6, rounding = 1e-11;
    const CellRange<Dim> range = region.range();
    std::optional<IVec<Dim>> best;
    double least = 1e300;
    each_cell(range, [&](const IVec<Dim>& i) {
      const Site c = layout_.site(i);
      const double d = (centre_of(i) - region.middle()).squaredNorm() + tie * std::abs(share_[c] - 0.5);
      if (pieces_.has(c) && d < least - rounding) least = d, best = i;
      return true;
    });
    if (!best) return {};
    const CellPlane<Dim>& plane = pieces_[layout_.site(*best)];
    const bool flat = each_cell(range, [&](const IVec<Dim>& i) {
      const double offset = plane.offset - plane.normal.dot((i - *best).template cast<double>());
      return std::abs(share_below<Dim>(plane.normal, offset) - share_[layout_.site(i)]) < most;
    });
    return flat ? best : std::nullopt;
  }

  double below_plane(const IVec<Dim>& cell, const Simplex<Dim>& piece) const {
    const Site c = layout_.site(cell);
    if (!pieces_.has(c)) return share_[c] > 0.5 ? piece.measure : 0;
    const CellPlane<Dim>& plane = pieces_[c];
    const double offset = plane.offset + plane.normal.dot(cell.template cast<double>());
    CutSimplex<Dim> cut{};
    for (int k = 0; k <= Dim; ++k) cut.f[k] = plane.normal.dot(piece.corner[k]) - offset;
    cut.measure = std::abs(piece.measure);
    return std::copysign(negative_measure(cut), piece.measure);
  }

  const Layout<Dim>& layout_;
  const CountedShares<Dim>& share_;
  SurfacePieces<Dim> pieces_;
  bool quick_;
};

}  // namespace seiche
