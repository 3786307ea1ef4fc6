#pragma once
// Faces on the sides of the domain.
#include <algorithm>

#include "grid/layout.h"

namespace seiche {

// Owned faces on a side of the domain (0 lower, 1 upper). Empty if another rank owns it or the axis is periodic.
template <int Dim>
Box<Dim> faces_of_side(const Layout<Dim>& layout, int axis, int side) {
  if (layout.cells().empty() || !(side == 0 ? layout.at_lower(axis) : layout.at_upper(axis))) return {};
  Box<Dim> box = layout.faces(axis);
  if (side == 0)
    box.upper[axis] = box.lower[axis] + 1;
  else
    box.lower[axis] = box.upper[axis] - 1;
  return box;
}

// Faces on a side of the domain, two layers around this rank's cells included.
template <int Dim>
Box<Dim> padded_faces_of_side(const Layout<Dim>& layout, int axis, int side) {
  Box<Dim> box = layout.grown(2);
  const int edge = side == 0 ? 0 : layout.geometry().cells[axis];
  box.lower[axis] = std::max(box.lower[axis], edge);
  box.upper[axis] = std::min(box.upper[axis], edge + 1);
  return box;
}

}  // namespace seiche
