#pragma once
// Positions on a side of the domain.
#include <algorithm>
#include <cmath>

#include "grid/layout.h"

namespace seiche {

template <int Dim>
double side_position(const Layout<Dim>& layout, int axis, int side) {
  return layout.geometry().lower[axis] + (side == 0 ? 0 : layout.geometry().cells[axis] * layout.h());
}

// Moves x into the domain along the axes within a side: wraps around periodic ones, clamps along others.
template <int Dim>
Vec<Dim> bring_inside(const Layout<Dim>& layout, int axis, Vec<Dim> x) {
  const Geometry<Dim>& g = layout.geometry();
  for (int b = 0; b < Dim; ++b) {
    if (b == axis) continue;
    const double length = g.cells[b] * g.h, y = x[b] - g.lower[b];
    x[b] = g.lower[b] + (g.periodic[b] ? y - length * std::floor(y / length) : std::clamp(y, 0.0, length));
  }
  return x;
}

// Centre of the side's face that contains x.
template <int Dim>
Vec<Dim> center_of_face(const Layout<Dim>& layout, int axis, Vec<Dim> x) {
  const Geometry<Dim>& g = layout.geometry();
  for (int b = 0; b < Dim; ++b)
    if (b != axis)
      x[b] = g.lower[b] + g.h * (std::clamp(std::floor((x[b] - g.lower[b]) / g.h), 0.0, g.cells[b] - 1.0) + 0.5);
  return x;
}

}  // namespace seiche
