#pragma once
// Pieces of a solid's surface and the cells whose pressure acts on them.
#include <optional>

#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "geometry/mesh/facet_pieces.h"

namespace seiche {

template <int Dim>
class PlacedSolid;

// Solids that joints let reach into body k, and whose boxes meet its own.
template <int Dim>
std::vector<int> jointed_neighbours(const Solids<Dim>& solids, const std::vector<Placement>& placed, int k);

// The same where they are placed. No liquid acts on pieces that they cover. Keeps references.
template <int Dim>
class JointedNeighbours {
 public:
  JointedNeighbours(const Domain<Dim>& domain, const Solids<Dim>& solids, const StepGeometry<Dim>& g, int k);
  ~JointedNeighbours();
  bool any() const { return !near_.empty(); }
  // True if the point x (m) of the body's surface lies in another solid or on it.
  bool cover(const Vec<Dim>& x) const;

 private:
  double psi_at(const Vec<Dim>& x) const;

  const Domain<Dim>& domain_;
  const NodeField<Dim>& psi_;
  std::vector<std::unique_ptr<PlacedSolid<Dim>>> near_;
};

// A piece and the cell whose pressure acts on it: the cell that contains it. If that has no open face, the next open
// cell along the normal acts on it.
template <int Dim>
struct ExposedPiece {
  Site cell;
  FacetPiece<Dim> piece;
};

// Mean of a piece's corners, m.
template <int Dim>
Vec<Dim> middle_of(const FacetPiece<Dim>& piece, const SurfaceMesh& surface, const std::vector<Vec<Dim>>& points) {
  Vec<Dim> middle = Vec<Dim>::Zero();
  for (const Vec<Dim>& corner : corners_of(piece, surface, points)) middle += corner;
  return middle / double(piece.outline.size());
}

// Flags of cells with a face whose velocity is an unknown, ghosts filled. Collective.
template <int Dim>
CellField<Dim, char> open_cells(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces);

// Cells of a layout's padding that cut_at_cells() has to reach for the pieces on which a rank's cells act.
constexpr int reach_of_pieces = 2;

// The owned cell that acts on a piece in `cell` with this outward normal; none if another rank's does, or no cell.
// `open`: open_cells().
template <int Dim>
std::optional<Site> acting_cell(const Domain<Dim>& domain, const CellField<Dim, char>& open, const IVec<Dim>& cell,
                                const Vec<Dim>& normal);

// The pieces on which this rank's cells act. All ranks choose the same cell for a piece. Corners of the surface are at
// `points` (m). `open`: open_cells().
template <int Dim>
std::vector<ExposedPiece<Dim>> exposed_pieces(const Domain<Dim>& domain, const CellField<Dim, char>& open,
                                              const SurfaceMesh& surface, const std::vector<Vec<Dim>>& points,
                                              const JointedNeighbours<Dim>& neighbours);

// Density of the fluid whose pressure acts in a cell, 0 where there is none, kg/m^Dim.
template <int Dim>
double density_beside(const Fluids& fluids, const PressureRows<Dim>& rows, const CellField<Dim>& phi, Site cell) {
  return !rows.has_pressure(cell) ? 0 : phi[cell] < 0 ? fluids.density() : fluids.gas_density();
}

}  // namespace seiche
