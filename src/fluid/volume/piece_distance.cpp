#include "fluid/volume/piece_distance.h"

#include "fluid/volume/neighbours.h"
#include "fluid/volume/surface_pieces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Distance of x from the part of a plane in the unit cube: the point y = clamp(x - t n) with n.y = offset, by halving
// t.
template <int Dim>
double distance_of_piece(const CellPlane<Dim>& plane, const Vec<Dim>& x) {
  double low = -10, high = 10;
  const auto at = [&](double t) { return Vec<Dim>((x - t * plane.normal).cwiseMax(0).cwiseMin(1)); };
  for (int k = 0; k < 30; ++k) {
    const double t = 0.5 * (low + high);
    (plane.normal.dot(at(t)) > plane.offset ? low : high) = t;
  }
  return (at(0.5 * (low + high)) - x).norm();
}

// Distance of a cell's centre from the nearest point of the cell `offset` cells away, in cells.
template <int Dim>
double distance_of_cell(const IVec<Dim>& offset) {
  return (offset.template cast<double>().cwiseAbs().array() - 0.5).max(0).matrix().norm();
}

// Signed distance (m) of a cell's centre from the pieces of the cells within two, at most two cells.
template <int Dim>
double distance_of_pieces(const Layout<Dim>& layout, const SurfacePieces<Dim>& pieces, const CountedShares<Dim>& share,
                          Site c) {
  constexpr int reach = 2;
  const Vec<Dim> middle = Vec<Dim>::Constant(0.5);
  double least = reach;
  for (int n = 0; n < neighbour_count<Dim>(reach); ++n) {
    const IVec<Dim> o = neighbour_offset<Dim>(n, reach);
    const Site m = c + step_of(layout, o);
    if (!pieces.has(m) || distance_of_cell<Dim>(o) > least) continue;
    least = std::min(least, distance_of_piece<Dim>(pieces[m], middle - o.template cast<double>()));
  }
  const bool wet = pieces.has(c) ? pieces[c].normal.dot(middle) < pieces[c].offset : share[c] > 0.5;
  return (wet ? -least : least) * layout.h();
}

}  // namespace

template <int Dim>
std::int64_t rebuild_level_set(const Layout<Dim>& layout, const CellField<Dim, char>& marked, const CellField<Dim>& old,
                               const Ledger<Dim>& ledger, const CellField<Dim>& share, CellField<Dim>& phi) {
  const auto all = [&](int layers, const CellField<Dim, char>& mask) {
    return listed_possible(
        layout, layout.grown(layers), [&](Site c) { return any_marked(mask.data() + c); },
        [&](Site c) { return mask[c] != 0; });
  };
  const std::vector<Site> where = all(1, marked);
  if (where.empty()) return 0;
  CellField<Dim, char> rebuilt(layout), around(layout);
  mark_around(layout, where, 1, rebuilt);
  mark_around(layout, where, 3, around);
  const std::vector<Site> cells = all(0, rebuilt);
  const CountedShares<Dim> counted(layout, ledger, old, share);
  const SurfacePieces<Dim> pieces = surface_pieces(layout, layout.grown(2), old, counted, &around);
  for_each_listed(cells, [&](Site c) { phi[c] = distance_of_pieces(layout, pieces, counted, c); });
  return std::int64_t(cells.size());
}

template std::int64_t rebuild_level_set<2>(const Layout<2>&, const CellField<2, char>&, const CellField<2>&,
                                           const Ledger<2>&, const CellField<2>&, CellField<2>&);
template std::int64_t rebuild_level_set<3>(const Layout<3>&, const CellField<3, char>&, const CellField<3>&,
                                           const Ledger<3>&, const CellField<3>&, CellField<3>&);

}  // namespace seiche
