#pragma once
// Extends fields beyond the sides of the domain.
#include "grid/layout.h"

namespace seiche {

// constant: the outermost value inside or on the side. linear: continued linearly (planes stay planes), with a slope of
// at most `steepest` per cell. mirror: even about the side for values half a cell from it; odd about the side's own
// value for values on it (flow at a solid wall).
enum class Extension { constant, linear, mirror };
template <int Dim>
using Extensions = std::array<std::array<Extension, 2>, Dim>;

template <int Dim>
Extensions<Dim> all_sides(Extension e) {
  Extensions<Dim> r;
  for (auto& axis : r) axis = {e, e};
  return r;
}

// Fills every stored site beyond a non-periodic side. `offset`: location of the values in a cell (face_offset() etc.).
// The halo inside the domain must be up to date. Local.
template <int Dim>
void extend_beyond_sides(const Layout<Dim>& layout, double* f, const Vec<Dim>& offset, const Extensions<Dim>& rules,
                         double steepest = 1e300);

}  // namespace seiche
