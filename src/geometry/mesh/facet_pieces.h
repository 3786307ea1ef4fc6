#pragma once
// Cuts a surface at the cells of a grid.
#include <vector>

#include "geometry/mesh/facets.h"
#include "grid/layout.h"

namespace seiche {

// Barycentric weights of a facet's corners at one of its points.
template <int Dim>
using FacetWeights = Eigen::Matrix<double, Dim, 1>;

// The part of one facet (2D: a segment, 3D: a triangle) that lies in one cell.
template <int Dim>
struct FacetPiece {
  IVec<Dim> cell;                          // index over the whole grid
  int facet = 0;                           // index in the surface
  Vec<Dim> normal;                         // outward unit normal of the facet
  std::vector<FacetWeights<Dim>> outline;  // 2D: both ends, the one near the first corner first; 3D: a convex polygon
};

// The pieces of a surface in the cells of `box`, in the order of the facets. Corners are at `points` (m). A piece in
// the plane between two cells belongs to the cell on its outer side. Facets without area are skipped.
template <int Dim>
std::vector<FacetPiece<Dim>> cut_at_cells(const Geometry<Dim>& grid, const Box<Dim>& box, const SurfaceMesh& surface,
                                          const std::vector<Vec<Dim>>& points);

// Corners in space of a piece of a surface whose points are at `points` (m), in the order of its outline.
template <int Dim>
std::vector<Vec<Dim>> corners_of(const FacetPiece<Dim>& piece, const SurfaceMesh& surface,
                                 const std::vector<Vec<Dim>>& points) {
  const auto& facet = facets_of<Dim>(surface)[std::size_t(piece.facet)];
  std::vector<Vec<Dim>> corners;
  for (const FacetWeights<Dim>& weights : piece.outline) {
    corners.push_back(Vec<Dim>::Zero());
    for (int n = 0; n < Dim; ++n) corners.back() += weights[n] * points[std::size_t(facet[std::size_t(n)])];
  }
  return corners;
}

}  // namespace seiche
