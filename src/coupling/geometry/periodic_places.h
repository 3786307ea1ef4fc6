#pragma once
// Nodes and faces on periodic sides, which have a place on either side: what solids do there must be the same.
#include "grid/layout.h"

namespace seiche {

// From a face on a periodic side to its other place, along its axis, m; zero elsewhere.
template <int Dim>
double to_other_side(const Layout<Dim>& layout, int axis, const IVec<Dim>& i) {
  const Geometry<Dim>& g = layout.geometry();
  if (!g.periodic[axis] || (i[axis] != 0 && i[axis] != g.cells[axis])) return 0;
  return (i[axis] == 0 ? 1 : -1) * g.h * g.cells[axis];
}

// Least distance(x) over the places of a node: on periodic sides it has more than one, and faces there are to be as
// open at either.
template <int Dim, class Distance>
double least_distance(const Layout<Dim>& layout, const IVec<Dim>& i, const Distance& distance) {
  const Vec<Dim> x = layout.position(i, node_offset<Dim>());
  double least = distance(x);
  for (int places = 1; places < 1 << Dim; ++places) {
    Vec<Dim> other = x;
    bool exists = true;
    for (int a = 0; a < Dim; ++a) {
      const double shift = (places >> a) & 1 ? to_other_side(layout, a, i) : 0;
      exists = exists && (shift != 0 || !((places >> a) & 1));
      other[a] += shift;
    }
    if (exists) least = std::min(least, distance(other));
  }
  return least;
}

}  // namespace seiche
