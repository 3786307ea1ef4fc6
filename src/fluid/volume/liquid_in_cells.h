#pragma once
// The liquid as a set: full and empty cells, and planes in mixed ones.
#include "fluid/volume/grid_pieces.h"
#include "fluid/volume/surface_pieces.h"
#include "levelset/fractions.h"

namespace seiche {

// Known on this rank's cells and in their halo but its two outer layers.
template <int Dim>
class LiquidInCells {
 public:
  LiquidInCells(const Layout<Dim>& layout, const CellField<Dim>& phi, const CellField<Dim>& share)
      : layout_(layout), share_(share), pieces_(surface_pieces(layout, layout.grown(layout.halo() - 2), phi, share)) {}

  // 0 or 1 if all cells of a range are empty or full, else -1.
  int uniform(const CellRange<Dim>& range) const {
    IVec<Dim> i = range.lower;
    bool full = true, empty = true;
    for (;;) {
      const double v = share_[layout_.site(i)];
      full = full && v >= 1 - least_share;
      empty = empty && v <= least_share;
      if (!full && !empty) return -1;
      int a = 0;
      while (a < Dim && ++i[a] > range.upper[a]) i[a] = range.lower[a], ++a;
      if (a == Dim) return full ? 1 : 0;
    }
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
  double below_plane(const IVec<Dim>& cell, const Simplex<Dim>& piece) const {
    const std::int32_t n = pieces_.index[layout_.site(cell)];
    if (n < 0) return share_[layout_.site(cell)] > 0.5 ? piece.measure : 0;
    const CellPlane<Dim>& plane = pieces_.planes[std::size_t(n)];
    const double offset = plane.offset + plane.normal.dot(cell.template cast<double>());
    CutSimplex<Dim> cut{};
    for (int k = 0; k <= Dim; ++k) cut.f[k] = plane.normal.dot(piece.corner[k]) - offset;
    cut.measure = std::abs(piece.measure);
    return std::copysign(negative_measure(cut), piece.measure);
  }

  const Layout<Dim>& layout_;
  const CellField<Dim>& share_;
  SurfacePieces<Dim> pieces_;
};

}  // namespace seiche
