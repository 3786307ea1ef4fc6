#pragma once
// Faces on the sides of the domain.
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

}  // namespace seiche
