#pragma once
// Curvature of the surface phi = 0 where it crosses the links between cell centres.
#include "grid/fields.h"

namespace seiche {

// How a curvature was found: from heights of the surface over its tangent plane, or from the differences of phi.
enum class CurvatureSource { heights, differences };

struct SurfaceCurvature {
  double value = 0;  // 1/m, positive where the liquid (phi < 0) is convex; in 3D the sum of both principal ones
  CurvatureSource source = CurvatureSource::heights;
};

// Curvature where the surface crosses the link across a face, phi of different sign in its two cells. The surface is
// taken as a graph over its tangent there: heights along the normal at the crossing and h to each side of it (2D: 3,
// 3D: 5 zeros of the cubic interpolant of phi), kappa = -H''/(1 + H'^2)^(3/2) by second differences. On spheres of
// radius R the error is (h/R)^2/4 of kappa, whichever way the grid lies; heights over an axis, usual where all that is
// known are volumes of cells, lose 25 times as much on the diagonals in 3D. Where a height is not found, div(grad
// phi/|grad phi|) in both cells, interpolated. At most (Dim - 1)/h in magnitude: no rounder drop is resolved. phi valid
// four cells around the owned ones.
template <int Dim>
SurfaceCurvature curvature_at_crossing(const Layout<Dim>& layout, const CellField<Dim>& phi, int axis, Site face);

// div(grad phi/|grad phi|) at a cell's centre by second-order differences, 1/m.
template <int Dim>
double curvature_by_differences(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell);

}  // namespace seiche
