#include "fluid/volume/level_set_coupling.h"

#include <algorithm>
#include <cmath>

#include "fluid/volume/piece_distance.h"
#include "fluid/volume/spill.h"
#include "fluid/volume/volume_exchange.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr double apart = 0.35;  // shift, in cells, from which on the level set is rebuilt

// Mean of delta over the surface around the foot of a cell, in cells; 0 if there is none.
template <int Dim>
double shift_at(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& delta,
                const CellField<Dim>& phi, Site c) {
  constexpr int reach = 2;
  constexpr double radius2 = 6.25, flattest = 0.5;
  const double h = layout.h();
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) g[a] = (phi[c + layout.stride(a)] - phi[c - layout.stride(a)]) / (2 * h);
  const Vec<Dim> foot = -phi[c] / h * g / std::max(flattest, g.norm());
  IVec<Dim> nearest;
  for (int a = 0; a < Dim; ++a) nearest[a] = int(std::lround(foot[a]));
  double sum = 0, weight = 0;
  for (int n = 0; n < neighbour_count<Dim>(reach); ++n) {
    const IVec<Dim> o = nearest + neighbour_offset<Dim>(n, reach);
    const Site m = c + step_of(layout, o);
    if (!d.on_surface(m)) continue;
    const double w =
        d.area[m] * std::pow(std::max(0.0, 1 - (o.template cast<double>() - foot).squaredNorm() / radius2), 2);
    sum += w * delta[m];
    weight += w;
  }
  return weight > 0 ? sum / weight : 0;
}

// Share of the shift that the level set takes in a step. Small shifts are noise of both: phi that followed them at once
// would be rough, and curvature, waves and corners worse. The square lets the rest follow slowly.
double gain_of(double shift) {
  constexpr double small = 0.01, large = 0.1;
  const double size = std::abs(shift);
  return std::clamp(std::max((size - small) / (large - small), std::pow(size / large, 2)), 0.0, 1.0);
}

// Moves phi by the mean shift of the surface near each cell. Returns the volume it was moved by, in cells.
template <int Dim>
double shift_level_set(const Layout<Dim>& layout, const Difference<Dim>& d, const CellField<Dim>& delta,
                       CellField<Dim>& phi) {
  constexpr double widest = 3, largest = 0.5;
  const double limit = std::min(widest, layout.halo() - 2.5) * layout.h();
  const CellField<Dim> old = phi;
  for_each_site(layout, layout.cells(), [&](Site c) {
    if (std::abs(old[c]) > limit) return;
    const double shift = shift_at(layout, d, delta, old, c);
    phi[c] -= gain_of(shift) * std::clamp(shift, -largest, largest) * layout.h();
  });
  return local_sum(layout, layout.cells(), [&](Site c, const IVec<Dim>&) {
    return d.on_surface(c) ? d.area[c] * std::abs(phi[c] - old[c]) / layout.h() : 0.0;
  });
}

}  // namespace

template <int Dim>
Coupled couple_level_set(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                         const NodeField<Dim>& psi, const Ledger<Dim>& ledger, CellField<Dim>& phi,
                         CellField<Dim>& share) {
  const Difference<Dim> d(layout, psi, phi, ledger, share);
  Stray<Dim> stray(layout, d, phi, share);
  const std::vector<Site> surface = listed_possible(
      layout, layout.cells(), [](Site) { return true; }, [&](Site c) { return d.on_surface(c); });
  const CellField<Dim> delta = smooth_shift(layout, halo, d, surface, stray.rhs);
  for_each_site(layout, cells_around(layout, 2), [&](Site c) {
    if (std::abs(delta[c]) > apart) stray.rebuild[c] = 1;
  });
  for_each_site(layout, layout.cells(), [&](Site c) { share[c] += stray.change[c]; });
  fill_share_ghosts(layout, halo, share);
  Coupled r;
  r.volumes = exchange_short_waves(layout, d, delta, phi, stray.rebuild, surface, share);
  fill_share_ghosts(layout, halo, share);
  const CellField<Dim> old = phi;
  r.level_set = shift_level_set(layout, d, delta, phi);
  r.rebuilt = rebuild_level_set(layout, stray.rebuild, old, ledger, share, phi);
  fill_level_set_ghosts(layout, halo, phi);
  std::array<double, 3> sums{r.level_set, r.volumes, double(r.rebuilt)};
  ranks.global_sum(sums);
  return {sums[0], sums[1], std::int64_t(sums[2])};
}

template Coupled couple_level_set<2>(const Layout<2>&, const Halo<2>&, const Communicator&, const NodeField<2>&,
                                     const Ledger<2>&, CellField<2>&, CellField<2>&);
template Coupled couple_level_set<3>(const Layout<3>&, const Halo<3>&, const Communicator&, const NodeField<3>&,
                                     const Ledger<3>&, CellField<3>&, CellField<3>&);

}  // namespace seiche
