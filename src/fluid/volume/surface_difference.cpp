#include "fluid/volume/surface_difference.h"

#include "base/parallel_range.h"
#include "fluid/volume/own_side.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr double least_area = 0.02;  // of the surface in a cell that takes part, in cells^(Dim-1)
constexpr double reached = 1.6;      // cells from the surface within which a cell may be mixed

}  // namespace

template <int Dim>
bool Difference<Dim>::on_surface(Site c) const {
  return area[c] > least_area;
}

template <int Dim>
Difference<Dim>::Difference(const Layout<Dim>& layout, const NodeField<Dim>& psi, const CellField<Dim>& phi,
                            const Ledger<Dim>& ledger, const CellField<Dim>& share)
    : area(layout), missing(layout), room(ledger.room) {
  const double h = layout.h();
  const auto may_differ = [&](Site c) {
    return !all_zero(share.data() + c) || !all_above(phi.data() + c, reached * h);
  };
  for_each_possible(layout, cells_around(layout, layout.halo() - 1), may_differ, [&](Site c) {
    const double v = share[c];
    if (std::abs(phi[c]) < reached * h) {
      const VolumeAndArea found = share_and_area(layout, room, phi, psi, c);
      area[c] = found.area;
      missing[c] = is_deep(layout, ledger, phi, share, c) ? 0 : v - std::min(found.volume, room.of(c));
    } else if (const double by_level_set = phi[c] < 0 ? room.of(c) : 0;
               v != by_level_set && !is_deep(layout, ledger, phi, share, c)) {
      missing[c] = v - by_level_set;
    }
  });
}

namespace {

// The links of each cell of a list, one cell after another.
template <int Dim>
struct Links {
  struct Link {
    Site to;
    double weight;
  };
  std::vector<Link> all;
  std::vector<std::size_t> first;  // of each cell, and the end

  Links(const Layout<Dim>& layout, const Difference<Dim>& d, const std::vector<Site>& cells) {
    all.reserve(16 * cells.size()), first.reserve(cells.size() + 1);
    for (const Site c : cells) {
      first.push_back(all.size());
      visit_links(layout, d, c, [&](Site m, double w) { all.push_back({m, w}); });
    }
    first.push_back(all.size());
  }
};

}  // namespace

template <int Dim>
CellField<Dim> smooth_shift(const Layout<Dim>& layout, const Halo<Dim>& halo, const Difference<Dim>& d,
                            const std::vector<Site>& surface, const CellField<Dim>& rhs) {
  constexpr int steps = 24;
  constexpr double largest = 2, least = 1.0 / 90, theta = (largest + least) / 2, width = (largest - least) / 2;
  const Links<Dim> links(layout, d, surface);
  CellField<Dim> delta(layout);
  std::vector<double> change(surface.size()), next(surface.size());
  double rho = width / theta;
  for (int k = 0; k < steps; ++k) {
    const double after = 1 / (2 * theta / width - rho), keep = k == 0 ? 0 : rho * after,
                 gain = k == 0 ? 1 / theta : 2 * after / width;
    parallel_range_in_tasks(surface.size(), 512, [&](std::size_t n) {
      const Site c = surface[n];
      double residual = rhs[c] - d.area[c] * delta[c], diagonal = d.area[c];
      for (std::size_t l = links.first[n]; l < links.first[n + 1]; ++l) {
        residual += links.all[l].weight * (delta[links.all[l].to] - delta[c]);
        diagonal += links.all[l].weight;
      }
      change[n] = keep * change[n] + gain * residual / diagonal;
      next[n] = delta[c] + change[n];
    });
    for (std::size_t n = 0; n < surface.size(); ++n) delta[surface[n]] = next[n];
    if (k > 0) rho = after;
    halo.fill_ghosts(delta);
  }
  return delta;
}

#define SEICHE_INSTANTIATE(D)                                                                   \
  template struct Difference<D>;                                                                \
  template CellField<D> smooth_shift<D>(const Layout<D>&, const Halo<D>&, const Difference<D>&, \
                                        const std::vector<Site>&, const CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
