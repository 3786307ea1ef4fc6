#include "geometry/mesh/facet_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/mesh/facets.h"

namespace seiche {
namespace {

template <int Dim>
using FacetPart = std::vector<FacetWeights<Dim>>;

// Columns are the facet's corners, in cells from the grid's lower corner.
template <int Dim>
using Corners = Eigen::Matrix<double, Dim, Dim>;

// Distance beyond a facet at which the cell of a piece is looked up, in cells: far above round-off, far below h.
constexpr double outward = 1e-9;

// Normal with the length (2D) or area (3D) of the facet. The inside lies left of segments; triangles are
// counter-clockwise seen from outside.
Vec<2> area_normal(const Corners<2>& p) {
  return {p(1, 1) - p(1, 0), p(0, 0) - p(0, 1)};
}
Vec<3> area_normal(const Corners<3>& p) {
  return 0.5 * (p.col(1) - p.col(0)).cross(p.col(2) - p.col(0));
}

// Splits a part at the plane where the coordinate along an axis equals `plane` (cells).
template <int Dim>
void split(const Corners<Dim>& p, int axis, double plane, const FacetPart<Dim>& part, FacetPart<Dim>& below,
           FacetPart<Dim>& above) {
  const auto height = [&](const FacetWeights<Dim>& w) { return p.row(axis).dot(w) - plane; };
  const std::size_t sides = Dim == 2 ? part.size() - 1 : part.size();
  for (std::size_t n = 0; n < part.size(); ++n) {
    const double here = height(part[n]);
    if (here <= 0) below.push_back(part[n]);
    if (here >= 0) above.push_back(part[n]);
    if (n >= sides) continue;
    const FacetWeights<Dim>& next = part[(n + 1) % part.size()];
    const double there = height(next);
    if (here * there >= 0) continue;
    const double share = here / (here - there);
    const FacetWeights<Dim> between = (1 - share) * part[n] + share * next;
    below.push_back(between);
    above.push_back(between);
  }
}

// Cuts a part at all planes between cells along an axis, and drops what lies before the plane `first` or after `last`.
template <int Dim>
void cut_along(const Corners<Dim>& p, int axis, int first, int last, const FacetPart<Dim>& part,
               std::vector<FacetPart<Dim>>& pieces) {
  double low = 1e300, high = -1e300;
  for (const FacetWeights<Dim>& w : part)
    low = std::min(low, p.row(axis).dot(w)), high = std::max(high, p.row(axis).dot(w));
  if (high - low < outward) return pieces.push_back(part);  // in a plane of the grid its corners lie about it by chance
  FacetPart<Dim> rest = part;
  for (double plane = std::max(std::floor(low) + 1, double(first)); plane < high; plane += 1) {
    FacetPart<Dim> below, above;
    split(p, axis, plane, rest, below, above);
    if (below.size() >= Dim && plane > first) pieces.push_back(std::move(below));
    if (plane >= last) return;
    rest = std::move(above);
  }
  if (rest.size() >= Dim) pieces.push_back(std::move(rest));
}

// Cuts a facet along all axes. Parts beyond the box are dropped before they are cut further.
template <int Dim>
std::vector<FacetPart<Dim>> cut(const Corners<Dim>& p, const Box<Dim>& box) {
  std::vector<FacetPart<Dim>> parts(1);
  for (int i = 0; i < Dim; ++i) parts[0].push_back(FacetWeights<Dim>::Unit(i));
  for (int a = 0; a < Dim; ++a) {
    std::vector<FacetPart<Dim>> finer;
    for (const FacetPart<Dim>& part : parts) cut_along(p, a, box.lower[a], box.upper[a], part, finer);
    parts = std::move(finer);
  }
  return parts;
}

template <int Dim>
IVec<Dim> cell_beside(const Corners<Dim>& p, const FacetPart<Dim>& part, const Vec<Dim>& normal) {
  FacetWeights<Dim> middle = FacetWeights<Dim>::Zero();
  for (const FacetWeights<Dim>& w : part) middle += w / double(part.size());
  const Vec<Dim> x = p * middle + outward * normal;
  IVec<Dim> cell;
  for (int a = 0; a < Dim; ++a) cell[a] = int(std::floor(x[a]));
  return cell;
}

// False if the facet's bounding box does not meet a box of cells.
template <int Dim>
bool may_meet(const Corners<Dim>& p, const Box<Dim>& box) {
  for (int a = 0; a < Dim; ++a)
    if (p.row(a).maxCoeff() < box.lower[a] - outward || p.row(a).minCoeff() > box.upper[a] + outward) return false;
  return true;
}

}  // namespace

template <int Dim>
std::vector<FacetPiece<Dim>> cut_at_cells(const Geometry<Dim>& grid, const Box<Dim>& box, const SurfaceMesh& surface,
                                          const std::vector<Vec<Dim>>& points) {
  std::vector<FacetPiece<Dim>> pieces;
  const auto& facets = facets_of<Dim>(surface);
  for (std::size_t n = 0; n < facets.size(); ++n) {
    Corners<Dim> p;
    for (int i = 0; i < Dim; ++i) p.col(i) = (points[std::size_t(facets[n][std::size_t(i)])] - grid.lower) / grid.h;
    const Vec<Dim> normal = area_normal(p);
    if (normal.norm() == 0 || !may_meet(p, box)) continue;
    for (FacetPart<Dim>& part : cut(p, box)) {
      const IVec<Dim> cell = cell_beside<Dim>(p, part, normal.normalized());
      if (box.contains(cell)) pieces.push_back({cell, int(n), normal.normalized(), std::move(part)});
    }
  }
  return pieces;
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template std::vector<FacetPiece<D>> cut_at_cells<D>(const Geometry<D>&, const Box<D>&, const SurfaceMesh&, \
                                                      const std::vector<Vec<D>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
