#pragma once
// Planes that stand for the surface in the cells that liquid fills in part (PLIC).
#include <cstdint>
#include <vector>

#include "fluid/volume/cell_plane.h"
#include "fluid/volume/ledger.h"

namespace seiche {

// A cell with a share outside of this margin of 0 and 1 has a plane.
constexpr double least_share = 1e-9;
inline bool is_mixed(double share) {
  return share > least_share && share < 1 - least_share;
}

// The planes of the mixed cells of a box.
template <int Dim>
struct SurfacePieces {
  CellField<Dim, std::int32_t> number;  // place in the list + 1; 0: there is none
  std::vector<CellPlane<Dim>> planes;

  bool has(Site c) const { return number[c] > 0; }
  const CellPlane<Dim>& operator[](Site c) const { return planes[std::size_t(number[c] - 1)]; }
};

// Planes below which each mixed cell of `box` has its share of liquid. Normals from phi (m) where it is smooth, else
// from columns of shares (ELVIRA; Pilliod, Puckett 2004). phi and share must be valid two cells around the box.
// `where`: the cells that are wanted; null: all. Local.
template <int Dim>
SurfacePieces<Dim> surface_pieces(const Layout<Dim>& layout, const Box<Dim>& box, const CellField<Dim>& phi,
                                  const CountedShares<Dim>& share, const CellField<Dim, char>* where = nullptr);

// True if phi has no kink within a cell of this one: no second difference above 0.35 h.
template <int Dim>
bool is_smooth(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell);

}  // namespace seiche
