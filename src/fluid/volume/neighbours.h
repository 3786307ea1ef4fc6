#pragma once
// The cells within some cells of one along each axis.
#include <algorithm>
#include <atomic>

#include "grid/fields.h"
#include "grid/loops.h"

namespace seiche {

constexpr int power_of(int base, int exponent) {
  return exponent == 0 ? 1 : base * power_of(base, exponent - 1);
}

// Number of cells within `reach` of a cell, with itself; it comes in the middle.
template <int Dim>
constexpr int neighbour_count(int reach = 1) {
  return power_of(2 * reach + 1, Dim);
}

// Offset of neighbour n, 0 <= n < neighbour_count(reach).
template <int Dim>
IVec<Dim> neighbour_offset(int n, int reach = 1) {
  IVec<Dim> o;
  for (int a = 0; a < Dim; ++a, n /= 2 * reach + 1) o[a] = n % (2 * reach + 1) - reach;
  return o;
}

// Difference of sites for an offset in cells.
template <int Dim>
Site step_of(const Layout<Dim>& layout, const IVec<Dim>& offset) {
  Site s = 0;
  for (int a = 0; a < Dim; ++a) s += offset[a] * layout.stride(a);
  return s;
}

template <int Dim>
bool lies_in_domain(const Geometry<Dim>& g, const IVec<Dim>& cell) {
  for (int a = 0; a < Dim; ++a)
    if (!g.periodic[a] && (cell[a] < 0 || cell[a] >= g.cells[a])) return false;
  return true;
}

// The owned cells and n cells around them, as far as they lie in the domain.
template <int Dim>
Box<Dim> cells_around(const Layout<Dim>& layout, int n) {
  Box<Dim> box = layout.grown(n);
  for (int a = 0; a < Dim; ++a) {
    if (layout.geometry().periodic[a]) continue;
    box.lower[a] = std::max(box.lower[a], 0);
    box.upper[a] = std::min(box.upper[a], layout.geometry().cells[a]);
  }
  return box;
}

// Sets mask within `reach` cells of each site along each axis, as far as cells are stored.
template <int Dim>
void mark_around(const Layout<Dim>& layout, const std::vector<Site>& sites, int reach, CellField<Dim, char>& mask) {
  const Box<Dim> all = layout.padded();
  for_each_listed(sites, [&](Site c) {
    const IVec<Dim> i = layout.index(c);
    const Box<Dim> around = Box<Dim>{i.array() - reach, i.array() + reach + 1}.cut(all);
    IVec<Dim> at = around.lower;
    for (;;) {
      char* row = &mask[layout.site(at)];
      for (int n = 0; n < around.upper[0] - around.lower[0]; ++n)  // other threads may set the same
        std::atomic_ref<char>(row[n]).store(1, std::memory_order_relaxed);
      int a = 1;
      while (a < Dim && ++at[a] == around.upper[a]) at[a] = around.lower[a], ++a;
      if (a == Dim) return;
    }
  });
}

}  // namespace seiche
