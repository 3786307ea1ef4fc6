#pragma once
// Volume fractions of viscous liquid in each cell and in each edge's dual cell.
#include "fluid/viscosity/viscosity.h"

namespace seiche {

// The planes (a, b) perpendicular to edges: one in 2D, three in 3D.
template <int Dim>
constexpr int planes = Dim == 3 ? 3 : 1;
template <int Dim>
constexpr std::array<int, 2> plane_axes(int plane) {
  return Dim == 3 ? std::array<int, 2>{(plane + 1) % 3, (plane + 2) % 3} : std::array<int, 2>{0, 1};
}

// V, 0..1, on the owned cells and one layer around. Air and free-slip solids are void. In no-slip solids only phi
// decides.
template <int Dim>
struct ViscousShares {
  CellField<Dim> cell;
  EdgeField<Dim> edge;
};

template <int Dim>
ViscousShares<Dim> viscous_shares(const ViscousInput<Dim>& in);

}  // namespace seiche
