#pragma once
// Loads of a pressure on pieces of a solid's surface.
#include <algorithm>

#include "coupling/solids/exposed_surface.h"

namespace seiche {

// visit(x, weight) for the points (m) and weights (m^(Dim-1)) of a rule for a plane piece that is exact for polynomials
// of second degree, as in the moment of a linear pressure: Gauss's two points of a segment, the middles of the sides of
// triangles.
template <int Dim, class Visit>
void for_each_point_on(const std::vector<Vec<Dim>>& corners, const Visit& visit) {
  if constexpr (Dim == 2) {
    const Vec<2> middle = 0.5 * (corners[0] + corners[1]), half = 0.5 * (corners[1] - corners[0]);
    for (const double side : {-1.0, 1.0}) visit(Vec<2>(middle + side / std::sqrt(3.0) * half), half.norm());
  } else {
    for (std::size_t n = 2; n < corners.size(); ++n) {
      const std::array<Vec<3>, 3> t{corners[0], corners[n - 1], corners[n]};
      const double area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
      for (std::size_t a = 0; a < 3; ++a) visit(Vec<3>(0.5 * (t[a] + t[(a + 1) % 3])), area / 3);
    }
  }
}

// The points of a surface in a pose, m.
template <int Dim>
std::vector<Vec<Dim>> placed_points(const SurfaceMesh& surface, const Pose& pose) {
  std::vector<Vec<Dim>> points;
  for (const Vec3& X : surface.points) points.push_back(truncate<Dim>(pose.apply(X)));
  return points;
}

// True if all points (m) lie in the domain, at least `margin` cells from its sides, but for rounding.
template <int Dim>
bool lies_within(const Geometry<Dim>& grid, const std::vector<Vec<Dim>>& points, double margin = 0) {
  constexpr double rounding = 1e-9;  // cells
  return std::all_of(points.begin(), points.end(), [&](const Vec<Dim>& x) {
    const Vec<Dim> at = (x - grid.lower) / grid.h;  // cells
    for (int a = 0; a < Dim; ++a)
      if (at[a] < margin - rounding || at[a] > grid.cells[a] - margin + rounding) return false;
    return true;
  });
}

// The load -int p n dA (N) and its moment about `center` (N m) over pieces of a surface with its corners at `points`
// (m). p(cell, x): Pa, at a point x (m) of a piece on which the cell acts. This rank's part.
template <int Dim, class Pressure>
SolidLoad load_on_pieces(const std::vector<ExposedPiece<Dim>>& pieces, const SurfaceMesh& surface,
                         const std::vector<Vec<Dim>>& points, const Vec3& center, const Pressure& p) {
  SolidLoad load;
  for (const ExposedPiece<Dim>& exposed : pieces)
    for_each_point_on(corners_of(exposed.piece, surface, points), [&](const Vec<Dim>& at, double weight) {
      const Vec3 x = extend<Dim>(at), force = -p(exposed.cell, x) * weight * extend<Dim>(exposed.piece.normal);
      load.force += force;
      load.torque += (x - center).cross(force);
    });
  return load;
}

}  // namespace seiche
