#include "coupling/solids/exposed_surface.h"

#include <algorithm>
#include <numeric>

#include "coupling/geometry/placed_solid.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Offsets from a piece's cell to the cells that may act on it: none, one cell along each axis in the order of |n_a|,
// then two cells along the first. Axes with |n_a| <= 0.2 are skipped: a facet that stands on a floor does not face the
// cells beside it.
template <int Dim>
std::vector<IVec<Dim>> steps_outward(const Vec<Dim>& normal) {
  std::array<int, Dim> axes;
  std::iota(axes.begin(), axes.end(), 0);
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return std::abs(normal[a]) > std::abs(normal[b]); });
  std::vector<IVec<Dim>> steps{IVec<Dim>::Zero()};
  constexpr double least = 0.2;
  for (const int a : axes)
    if (std::abs(normal[a]) > least) steps.push_back((normal[a] > 0 ? 1 : -1) * IVec<Dim>::Unit(a));
  steps.push_back(2 * steps[1]);
  return steps;
}

}  // namespace

template <int Dim>
std::vector<int> jointed_neighbours(const Solids<Dim>& solids, const std::vector<Placement>& placed, int k) {
  const auto box = [&](int n) { return placed_box(solids.bodies[std::size_t(n)], placed[std::size_t(n)]); };
  std::vector<int> near;
  for (const auto& [a, b] : solids.apart)
    if ((a == k || b == k) && box(a).intersects(box(b))) near.push_back(a == k ? b : a);
  return near;
}

template <int Dim>
JointedNeighbours<Dim>::JointedNeighbours(const Domain<Dim>& domain, const Solids<Dim>& solids,
                                          const StepGeometry<Dim>& g, int k)
    : domain_(domain), psi_(g.psi) {
  for (const int n : jointed_neighbours(solids, g.placed, k))
    near_.push_back(place_solid(domain.layout, solids.bodies[std::size_t(n)], g.placed[std::size_t(n)]));
}

template <int Dim>
JointedNeighbours<Dim>::~JointedNeighbours() = default;

// Deep in a solid that deforms, where it has no distance, psi of all solids tells: the body's own is 0.
template <int Dim>
bool JointedNeighbours<Dim>::cover(const Vec<Dim>& x) const {
  constexpr double touching = 1e-2, deep = 0.5;  // cells
  const double h = domain_.layout.h();
  return std::any_of(near_.begin(), near_.end(), [&](const auto& solid) {
    return solid->distance(x) < touching * h || (solid->deforms() && psi_at(x) < -deep * h);
  });
}

template <int Dim>
double JointedNeighbours<Dim>::psi_at(const Vec<Dim>& x) const {
  const Geometry<Dim>& grid = domain_.layout.geometry();
  IVec<Dim> i;
  for (int a = 0; a < Dim; ++a) i[a] = int(std::floor((x[a] - grid.lower[a]) / grid.h + 0.5));
  return domain_.layout.padded().contains(i) ? psi_[domain_.layout.site(i)] : 0;
}

template <int Dim>
CellField<Dim, char> open_cells(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces) {
  CellField<Dim, char> open(domain.layout);
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    for_each_face_of(domain.layout, c, [&](int a, Site f, int, Site) { open[c] |= faces.is_unknown(a, f); });
  });
  domain.halo.fill_ghosts({open.data()});
  return open;
}

template <int Dim>
std::optional<Site> acting_cell(const Domain<Dim>& domain, const CellField<Dim, char>& open, const IVec<Dim>& cell,
                                const Vec<Dim>& normal) {
  for (const IVec<Dim>& step : steps_outward<Dim>(normal)) {
    const IVec<Dim> there = cell + step;
    const Site c = domain.layout.site(there);
    if (open[c]) return domain.layout.cells().contains(there) ? std::optional(c) : std::nullopt;
  }
  return {};
}

template <int Dim>
std::vector<ExposedPiece<Dim>> exposed_pieces(const Domain<Dim>& domain, const CellField<Dim, char>& open,
                                              const SurfaceMesh& surface, const std::vector<Vec<Dim>>& points,
                                              const JointedNeighbours<Dim>& neighbours) {
  std::vector<FacetPiece<Dim>> pieces =
      cut_at_cells(domain.layout.geometry(), domain.layout.grown(reach_of_pieces), surface, points);
  const auto covered = [&](const FacetPiece<Dim>& piece) {
    return neighbours.cover(middle_of(piece, surface, points));
  };
  if (neighbours.any()) pieces.erase(std::remove_if(pieces.begin(), pieces.end(), covered), pieces.end());
  std::vector<ExposedPiece<Dim>> exposed;
  for (FacetPiece<Dim>& piece : pieces)
    if (const auto c = acting_cell(domain, open, piece.cell, piece.normal)) exposed.push_back({*c, std::move(piece)});
  return exposed;
}

#define SEICHE_INSTANTIATE(D)                                                                              \
  template std::vector<int> jointed_neighbours<D>(const Solids<D>&, const std::vector<Placement>&, int);   \
  template class JointedNeighbours<D>;                                                                     \
  template CellField<D, char> open_cells<D>(const Domain<D>&, const FaceGeometry<D>&);                     \
  template std::optional<Site> acting_cell<D>(const Domain<D>&, const CellField<D, char>&, const IVec<D>&, \
                                              const Vec<D>&);                                              \
  template std::vector<ExposedPiece<D>> exposed_pieces<D>(const Domain<D>&, const CellField<D, char>&,     \
                                                          const SurfaceMesh&, const std::vector<Vec<D>>&,  \
                                                          const JointedNeighbours<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
