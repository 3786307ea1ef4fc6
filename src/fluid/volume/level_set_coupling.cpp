#include "fluid/volume/level_set_coupling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fluid/volume/piece_distance.h"
#include "fluid/volume/spill.h"
#include "fluid/volume/volume_exchange.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr double apart = 0.35;  // shift, in cells, from which on the level set is rebuilt

// The cells within two of one.
template <int Dim>
struct SurfaceAround {
  static constexpr int reach = 2;
  std::array<Site, std::size_t(neighbour_count<Dim>(reach))> step;
  std::array<Vec<Dim>, std::size_t(neighbour_count<Dim>(reach))> offset;

  explicit SurfaceAround(const Layout<Dim>& layout) {
    for (std::size_t n = 0; n < step.size(); ++n) {
      const IVec<Dim> o = neighbour_offset<Dim>(int(n), reach);
      step[n] = step_of(layout, o);
      offset[n] = o.template cast<double>();
    }
  }
};

// Mean of delta over the surface around the foot of a cell, in cells; 0 if there is none.
template <int Dim>
double shift_at(const Layout<Dim>& layout, const SurfaceAround<Dim>& around, const Difference<Dim>& d,
                const CellField<Dim>& delta, const CellField<Dim>& phi, Site c) {
  constexpr double radius2 = 6.25, flattest = 0.5;
  const double h = layout.h();
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) g[a] = (phi[c + layout.stride(a)] - phi[c - layout.stride(a)]) / (2 * h);
  const Vec<Dim> foot = -phi[c] / h * g / std::max(flattest, g.norm());
  IVec<Dim> nearest;
  for (int a = 0; a < Dim; ++a) nearest[a] = int(std::lround(foot[a]));
  const Site middle = c + step_of(layout, nearest);
  const Vec<Dim> from = foot - nearest.template cast<double>();
  double sum = 0, weight = 0;
  for (std::size_t n = 0; n < around.step.size(); ++n) {
    const Site m = middle + around.step[n];
    if (!d.on_surface(m)) continue;
    const double near = std::max(0.0, 1 - (around.offset[n] - from).squaredNorm() / radius2),
                 w = d.area[m] * near * near;
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
  // Squares of rounding moved phi = 0 to -6e-47 m, and the link of such a cell to the air became as short.
  constexpr double widest = 3, largest = 0.5, rounding = 1e-14;
  const double limit = std::min(widest, layout.halo() - 2.5) * layout.h();
  const CellField<Dim> old = phi;
  const SurfaceAround<Dim> around(layout);
  for_each_possible(
      layout, layout.cells(), [&](Site c) { return any_within(old.data() + c, 1.001 * limit); },
      [&](Site c) {
        if (std::abs(old[c]) > limit) return;
        const double shift = shift_at(layout, around, d, delta, old, c);
        const double part = gain_of(shift) * std::clamp(shift, -largest, largest);
        if (std::abs(part) > rounding) phi[c] -= part * layout.h();
      });
  return local_sum_of_possible(
      layout, layout.cells(), [&](Site c) { return !all_zero(d.area.data() + c); },
      [&](Site c) { return d.on_surface(c) ? d.area[c] * std::abs(phi[c] - old[c]) / layout.h() : 0.0; });
}

}  // namespace

template <int Dim>
Coupled couple_level_set(const Layout<Dim>& layout, const Halo<Dim>& halo, const Communicator& ranks,
                         const NodeField<Dim>& psi, const Ledger<Dim>& ledger, CellField<Dim>& phi,
                         CellField<Dim>& share) {
  const Difference<Dim> d(layout, psi, phi, ledger, share);
  Stray<Dim> stray(layout, d, phi, share);
  const std::vector<Site> surface = listed_possible(
      layout, layout.cells(), [&](Site c) { return !all_zero(d.area.data() + c); },
      [&](Site c) { return d.on_surface(c); });
  const CellField<Dim> delta = smooth_shift(layout, halo, d, surface, stray.rhs);
  const auto moves = [&](Site c) { return !all_zero(delta.data() + c); };
  for_each_possible(layout, cells_around(layout, 2), moves, [&](Site c) {
    if (std::abs(delta[c]) > apart) stray.rebuild[c] = 1;
  });
  for_each_possible(
      layout, layout.cells(), [&](Site c) { return !all_zero(stray.change.data() + c); },
      [&](Site c) { share[c] += stray.change[c]; });
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
