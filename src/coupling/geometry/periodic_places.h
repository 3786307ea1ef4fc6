#pragma once
// Nodes and faces on periodic sides exist twice, once at each side. Solid geometry must be the same at all images.
#include "grid/layout.h"

namespace seiche {

// Signed offset along `axis` (m) from a face on a periodic side to its image on the opposite side. Zero elsewhere.
template <int Dim>
double to_other_side(const Layout<Dim>& layout, int axis, const IVec<Dim>& i) {
  const Geometry<Dim>& g = layout.geometry();
  if (!g.periodic[axis] || (i[axis] != 0 && i[axis] != g.cells[axis])) return 0;
  return (i[axis] == 0 ? 1 : -1) * g.h * g.cells[axis];
}

// Least distance(x) over the periodic images of a node, so that faces are equally open at all images.
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
