#pragma once
// Curvature of the surface phi = 0 where it crosses the links between cell centres.
#include "grid/fields.h"

namespace seiche {

// Method that gave a curvature: heights of the surface over its tangent plane, or differences of phi.
enum class CurvatureSource { heights, differences };

struct SurfaceCurvature {
  double value = 0;  // 1/m, positive where the liquid (phi < 0) is convex; in 3D the sum of both principal curvatures
  CurvatureSource source = CurvatureSource::heights;
};

// Curvature at the point where the surface crosses the link across a face. phi must differ in sign in the face's two
// cells and be valid four cells around the owned ones.
//
// The surface is a graph H over its tangent plane at the crossing: kappa = -H''/(1 + H'^2)^(3/2) by second differences
// (in 3D the analogous sum). Heights are taken along the normal at the crossing and h to each side of it (2D: 3, 3D: 5
// zeros of the cubic interpolant of phi). On spheres of radius R the relative error is (h/R)^2/4 for all orientations
// of the grid. Heights along a grid axis, as in volume-of-fluid methods, have 25 times this error on the diagonals in
// 3D.
//
// If a height is not found, the result is div(grad phi/|grad phi|) interpolated between both cells. Magnitudes are
// limited to (Dim - 1)/h, since no smaller drop is resolved.
template <int Dim>
SurfaceCurvature curvature_at_crossing(const Layout<Dim>& layout, const CellField<Dim>& phi, int axis, Site face);

// div(grad phi/|grad phi|) at a cell centre by second-order differences, 1/m.
template <int Dim>
double curvature_by_differences(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell);

}  // namespace seiche
