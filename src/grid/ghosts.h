#pragma once
// Values beyond the sides of the domain, from those inside.
#include "grid/layout.h"

namespace seiche {

// constant: the value at the side; linear: continued in a straight line (planes stay
// planes), no steeper than `steepest` a cell; mirror: even about the
// side for values half a cell from it, odd about the side's own value for values that sit on it (a solid wall's flow).
enum class Extension { constant, linear, mirror };
template <int Dim>
using Extensions = std::array<std::array<Extension, 2>, Dim>;

template <int Dim>
Extensions<Dim> all_sides(Extension e) {
  Extensions<Dim> r;
  for (auto& axis : r) axis = {e, e};
  return r;
}

// Fills every stored site beyond a non-periodic side. Needs the halo inside the domain to be up to date; local.
template <int Dim>
void extend_beyond_sides(const Layout<Dim>& layout, double* f, const Vec<Dim>& offset, const Extensions<Dim>& rules,
                         double steepest = 1e300);

}  // namespace seiche
