#include "fluid/volume/surface_difference.h"

#include "grid/loops.h"
#include "levelset/fractions.h"

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
                            const CellField<Dim>& share)
    : area(layout), missing(layout) {
  constexpr double probe = 1e-3;
  const double h = layout.h();
  CellField<Dim> moved(layout);
  for_each_site(layout, layout.padded(), [&](Site c) { moved[c] = phi[c] - probe * h; });
  for_each_site(layout, cells_around(layout, layout.halo() - 1), [&](Site c) {
    double by_level_set = phi[c] < 0;
    if (std::abs(phi[c]) < reached * h) {
      by_level_set = liquid_share(layout, phi, psi, c);
      area[c] = (liquid_share(layout, moved, psi, c) - by_level_set) / probe;
    }
    missing[c] = share[c] - by_level_set;
  });
}

template <int Dim>
CellField<Dim> smooth_shift(const Layout<Dim>& layout, const Halo<Dim>& halo, const Difference<Dim>& d,
                            const std::vector<Site>& surface, const CellField<Dim>& rhs) {
  constexpr int steps = 24;
  constexpr double largest = 2, least = 1.0 / 90, theta = (largest + least) / 2, width = (largest - least) / 2;
  CellField<Dim> delta(layout), change(layout), old(layout);
  double rho = width / theta;
  for (int k = 0; k < steps; ++k) {
    const double next = 1 / (2 * theta / width - rho), keep = k == 0 ? 0 : rho * next,
                 gain = k == 0 ? 1 / theta : 2 * next / width;
    old = delta;
    for_each_listed(surface, [&](Site c) {
      double residual = rhs[c] - d.area[c] * old[c], diagonal = d.area[c];
      visit_links(layout, d, c, [&](Site m, double w) { residual += w * (old[m] - old[c]), diagonal += w; });
      change[c] = keep * change[c] + gain * residual / diagonal;
      delta[c] = old[c] + change[c];
    });
    if (k > 0) rho = next;
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
