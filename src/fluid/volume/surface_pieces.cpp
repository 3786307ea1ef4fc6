#include "fluid/volume/surface_pieces.h"

#include <algorithm>

#include "fluid/volume/neighbours.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Shares of a cell and its neighbours.
template <int Dim>
struct ShareBlock {
  static constexpr int count = neighbour_count<Dim>();
  std::array<double, count> share;

  ShareBlock(const Layout<Dim>& layout, const CountedShares<Dim>& field, Site c) {
    for (int n = 0; n < count; ++n)
      share[std::size_t(n)] = std::clamp(field[c + step_of(layout, neighbour_offset<Dim>(n))], 0.0, 1.0);
  }
  double at(const IVec<Dim>& o) const {
    int n = 0;
    for (int a = Dim - 1; a >= 0; --a) n = 3 * n + o[a] + 1;
    return share[std::size_t(n)];
  }
  // Liquid in the three cells along `axis` beside the middle one, `step` cells along `other`.
  double column(int axis, int other, int step) const {
    IVec<Dim> o = IVec<Dim>::Zero();
    o[other] = step;
    double sum = 0;
    for (o[axis] = -1; o[axis] <= 1; ++o[axis]) sum += at(o);
    return sum;
  }
  // Sum over the layer of cells `step` cells along the axis.
  double layer(int axis, int step) const {
    double sum = 0;
    for (int n = 0; n < count; ++n)
      if (neighbour_offset<Dim>(n)[axis] == step) sum += share[std::size_t(n)];
    return sum;
  }
  // Gradient of the shares, by the layers beside the middle cell: it points into the liquid.
  Vec<Dim> gradient() const {
    Vec<Dim> g;
    for (int a = 0; a < Dim; ++a) g[a] = layer(a, 1) - layer(a, -1);
    return g;
  }
  // Sum of squares of what the plane through the middle cell misses in all cells; stops above `most`.
  double misfit(const Vec<Dim>& normal, double most) const {
    constexpr double error = 1e-4;  // far below what tells normals apart
    const double middle = offset_of_share<Dim>(normal, share[std::size_t(count / 2)], error);
    double sum = 0;
    for (int n = 0; n < count && sum < most; ++n) {
      const double below =
          share_below<Dim>(normal, middle - normal.dot(neighbour_offset<Dim>(n).template cast<double>()));
      sum += std::pow(below - share[std::size_t(n)], 2);
    }
    return sum;
  }
};

// Slopes of the heights of columns along `axis`, backward, central and forward, for each other axis.
template <int Dim>
std::array<Vec<Dim>, 3> slopes(const ShareBlock<Dim>& s, int axis) {
  std::array<Vec<Dim>, 3> r;
  for (int b = 0; b < Dim; ++b) {
    if (b == axis) continue;
    const double low = s.column(axis, b, -1), here = s.column(axis, b, 0), high = s.column(axis, b, 1);
    r[0][b] = here - low;
    r[1][b] = 0.5 * (high - low);
    r[2][b] = high - here;
  }
  return r;
}

// The normal, of those that columns' slopes give, whose plane meets the shares around best. Columns along axes that the
// surface is far from crossing tell nothing. Zero if the shares have no gradient but for rounding.
template <int Dim>
Vec<Dim> normal_of_columns(const ShareBlock<Dim>& s) {
  constexpr double crossed = 0.5, dust = 1e-4, tie = 1e-6;  // of equal misfits the first one counts, not rounding
  constexpr double rounding = 1e-9;
  const Vec<Dim> gradient = s.gradient(), size = gradient.cwiseAbs();
  if (size.maxCoeff() < rounding) return Vec<Dim>::Zero();
  const double own = s.share[std::size_t(ShareBlock<Dim>::count / 2)];
  if (std::min(own, 1 - own) < dust && size.maxCoeff() > dust) return -gradient.normalized();
  Vec<Dim> best = Vec<Dim>::Unit(0);
  double least = 1e300;
  for (int axis = 0; axis < Dim; ++axis) {
    if (size[axis] < crossed * size.maxCoeff()) continue;
    const auto slope = slopes(s, axis);
    const double up = gradient[axis] < 0 ? 1 : -1;
    for (int choice = 0; choice < (Dim == 3 ? 9 : 3); ++choice) {
      Vec<Dim> n;
      for (int b = 0, rest = choice; b < Dim; ++b) {
        n[b] = b == axis ? up : -slope[std::size_t(rest % 3)][b];
        if (b != axis) rest /= 3;
      }
      n.normalize();
      const double found = s.misfit(n, least);
      if (found < (1 - tie) * least) least = found, best = n;
    }
  }
  return best;
}

// Gradient of phi by fourth-order differences, if it is near 1 and phi is smooth; else zero.
template <int Dim>
Vec<Dim> normal_of_level_set(const Layout<Dim>& layout, const CellField<Dim>& phi, Site c) {
  constexpr double near_surface = 1.2, flat = 0.7, steep = 1.4;
  if (std::abs(phi[c]) > near_surface * layout.h() || !is_smooth(layout, phi, c)) return Vec<Dim>::Zero();
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) {
    const Site d = layout.stride(a);
    g[a] = (8 * (phi[c + d] - phi[c - d]) - (phi[c + 2 * d] - phi[c - 2 * d])) / (12 * layout.h());
  }
  const double norm = g.norm();
  return norm > flat && norm < steep ? Vec<Dim>(g / norm) : Vec<Dim>::Zero();
}

// Normal by central differences of phi. They tell it in a mixed cell among cells that are all as full.
template <int Dim>
Vec<Dim> normal_of_differences(const Layout<Dim>& layout, const CellField<Dim>& phi, Site c) {
  constexpr double rounding = 1e-9;
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) g[a] = (phi[c + layout.stride(a)] - phi[c - layout.stride(a)]) / (2 * layout.h());
  return g.norm() > rounding ? Vec<Dim>(g.normalized()) : Vec<Dim>::Unit(0);
}

}  // namespace

template <int Dim>
bool is_smooth(const Layout<Dim>& layout, const CellField<Dim>& phi, Site cell) {
  constexpr double kink = 0.35;
  for (int n = 0; n < neighbour_count<Dim>(); ++n) {
    const Site c = cell + step_of(layout, neighbour_offset<Dim>(n));
    for (int a = 0; a < Dim; ++a) {
      const Site d = layout.stride(a);
      if (!(std::abs(phi[c + d] - 2 * phi[c] + phi[c - d]) < kink * layout.h())) return false;
    }
  }
  return true;
}

template <int Dim>
SurfacePieces<Dim> surface_pieces(const Layout<Dim>& layout, const Box<Dim>& box, const CellField<Dim>& phi,
                                  const CountedShares<Dim>& share, const CellField<Dim, char>* where) {
  SurfacePieces<Dim> r{CellField<Dim, std::int32_t>(layout), {}};
  const std::vector<Site> cells = listed_possible(
      layout, box, [&](Site c) { return where ? any_marked(where->data() + c) : !share.all_empty(c); },
      [&](Site c) { return (!where || (*where)[c]) && is_mixed(share[c]); });
  for (std::size_t n = 0; n < cells.size(); ++n) r.number[cells[n]] = std::int32_t(n + 1);
  r.planes.resize(cells.size());
  for_each_listed(cells, [&](Site c) {
    Vec<Dim> n = normal_of_level_set(layout, phi, c);
    if (n.isZero(0)) n = normal_of_columns(ShareBlock<Dim>(layout, share, c));
    if (n.isZero(0)) n = normal_of_differences(layout, phi, c);
    r.planes[std::size_t(r.number[c] - 1)] = {n, offset_of_share<Dim>(n, share[c])};
  });
  return r;
}

#define SEICHE_INSTANTIATE(D)                                                                       \
  template bool is_smooth<D>(const Layout<D>&, const CellField<D>&, Site);                          \
  template SurfacePieces<D> surface_pieces<D>(const Layout<D>&, const Box<D>&, const CellField<D>&, \
                                              const CountedShares<D>&, const CellField<D, char>*);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
