#pragma once
// Simplices cut at the planes of the grid into pieces that each lie in one cell. Coordinates are in cells from the
// domain's lower corner: cell i spans [i, i + 1].
#include <array>

#include <Eigen/LU>

#include "base/vec.h"

namespace seiche {

// Corners, and the measure, signed by their order.
template <int Dim>
struct Simplex {
  std::array<Vec<Dim>, Dim + 1> corner;
  double measure = 0;
};

// Signed measure of the simplex of an origin and a facet: det(facet - origin)/Dim!.
template <int Dim>
double signed_measure(const Vec<Dim>& origin, const std::array<Vec<Dim>, Dim>& facet) {
  Eigen::Matrix<double, Dim, Dim> edges;
  for (int k = 0; k < Dim; ++k) edges.row(k) = facet[k] - origin;
  return edges.determinant() / (Dim == 3 ? 6 : 2);
}

// Calls visit(piece) for simplices that tile s and do not cross the plane x_axis = at. Halves edges that cross it.
template <int Dim, class Visit>
void cut_at_plane(const Simplex<Dim>& s, int axis, double at, const Visit& visit) {
  int low = -1, high = -1;
  for (int k = 0; k <= Dim; ++k) {
    if (s.corner[k][axis] < at) low = k;
    if (s.corner[k][axis] > at) high = k;
  }
  if (low < 0 || high < 0) return visit(s);
  const Vec<Dim>&a = s.corner[low], &b = s.corner[high];
  const double t = (at - a[axis]) / (b[axis] - a[axis]);
  Vec<Dim> p = a + t * (b - a);
  p[axis] = at;
  Simplex<Dim> near_low = s, near_high = s;
  near_low.corner[high] = near_high.corner[low] = p;
  near_low.measure = t * s.measure;
  near_high.measure = (1 - t) * s.measure;
  cut_at_plane(near_low, axis, at, visit);
  cut_at_plane(near_high, axis, at, visit);
}

// Cells lower <= i <= upper.
template <int Dim>
struct CellRange {
  IVec<Dim> lower, upper;
};

// floor(x) and ceil(x) of numbers that an int holds.
inline int floor_of(double x) {
  const int n = int(x);
  return n - (x < n);
}
inline int ceil_of(double x) {
  const int n = int(x);
  return n + (x > n);
}

// The cells between two corners of a box.
template <int Dim>
CellRange<Dim> range_of(const Vec<Dim>& least, const Vec<Dim>& most) {
  CellRange<Dim> r;
  for (int a = 0; a < Dim; ++a) {
    r.lower[a] = floor_of(least[a]);
    r.upper[a] = std::max(r.lower[a], ceil_of(most[a]) - 1);
  }
  return r;
}

// The cells that a simplex reaches.
template <int Dim>
CellRange<Dim> range_of(const Simplex<Dim>& s) {
  Vec<Dim> least = s.corner[0], most = s.corner[0];
  for (const Vec<Dim>& x : s.corner) least = least.cwiseMin(x), most = most.cwiseMax(x);
  return range_of(least, most);
}

// Calls visit(cell, piece) for pieces that tile s, each in one cell. Leaves out those in a range of cells for which
// done(range, piece) is true.
template <int Dim, class Done, class Visit>
void visit_cells(const Simplex<Dim>& s, const Done& done, const Visit& visit) {
  if (s.measure == 0) return;
  const CellRange<Dim> range = range_of(s);
  if (done(range, s)) return;
  int widest = 0;
  for (int a = 1; a < Dim; ++a)
    if (range.upper[a] - range.lower[a] > range.upper[widest] - range.lower[widest]) widest = a;
  const int width = range.upper[widest] - range.lower[widest];
  if (width == 0) return visit(range.lower, s);
  const int middle = range.lower[widest] + (width + 1) / 2;
  cut_at_plane(s, widest, middle, [&](const Simplex<Dim>& piece) { visit_cells(piece, done, visit); });
}

}  // namespace seiche
