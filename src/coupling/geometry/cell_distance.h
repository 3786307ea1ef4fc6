#pragma once
// Signed distance to the solids at cell centres, interpolated from the nodes.
#include <utility>

#include "grid/fields.h"

namespace seiche {

// psi (m) at the centre of a cell and its gradient (m per cell), from the corner values.
template <int Dim>
std::pair<double, Vec<Dim>> distance_at_cell(const Layout<Dim>& layout, const NodeField<Dim>& psi, Site cell) {
  constexpr int corners = 1 << Dim;
  double mean = 0;
  Vec<Dim> g = Vec<Dim>::Zero();
  for (int k = 0; k < corners; ++k) {
    Site node = cell;
    for (int a = 0; a < Dim; ++a) node += ((k >> a) & 1) * layout.stride(a);
    mean += psi[node] / corners;
    for (int a = 0; a < Dim; ++a) g[a] += (((k >> a) & 1) ? 1 : -1) * psi[node] * 2 / corners;
  }
  return {mean, g};
}

}  // namespace seiche
