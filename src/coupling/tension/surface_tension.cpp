#include "coupling/tension/surface_tension.h"

#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/tension/contact_angle.h"
#include "coupling/tension/tension_balance.h"
#include "coupling/tension/tension_filter.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/curvature.h"

namespace seiche {
namespace {

constexpr double pi = 3.14159265358979323846;

// The density that both sides of the surface move with.
double density_at_surface(const Fluids& fluids) {
  return fluids.density() + fluids.gas_density();
}

// Where the scheme is semi-implicit and the step too long for explicit tension.
template <int Dim>
void filter_for_step(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi,
                     const FaceField<Dim, char>& crossed, double dt, FaceField<Dim>& kappa) {
  const LiquidSpec& liquid = fluids.liquid;
  if (liquid.tension_scheme != TensionScheme::semi_implicit) return;
  const double length = filter_length(liquid.surface_tension, density_at_surface(fluids), domain.layout.h(), dt);
  if (length == 0) return;
  domain.halo.fill_ghosts(kappa);
  filter_curvature(domain, phi, crossed, length, kappa);
}

// rho_f/rho of a link that the surface crosses.
double link_density(const Fluids& fluids, double phi_low, double phi_high) {
  const double theta = liquid_part(phi_low, phi_high);
  return theta + (1 - theta) * fluids.gas_density() / fluids.density();
}

// Links that the surface all but touches from their liquid cell's centre cross it in one place, and what their jumps
// differ by by error would blow through the cell at rho/rho_f (for one step, 15 m/s in a drop that swings at 0.4): for
// densities below a fiftieth, kappa goes over to the mean of the cell's links with such densities, weighted with
// rho/rho_f. Links that cross it farther off differ by what kappa does along the surface, which is what accelerates
// them along it. Halos of kappa and crossed filled.
template <int Dim>
void agree_in_slivers(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi,
                      const FaceField<Dim, char>& crossed, FaceField<Dim>& kappa) {
  constexpr double small = 0.02;
  const FaceField<Dim> old = kappa;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (!crossed.at(a, f)) return;
      const Site low = f - domain.layout.stride(a), cell = phi[f] < 0 ? f : low;
      const double nearness = 1 - link_density(fluids, phi[low], phi[f]) / small;
      if (nearness <= 0) return;
      double sum = 0, weights = 0;
      for_each_face_of(domain.layout, cell, [&](int b, Site g, int, Site across) {
        if (!crossed.at(b, g)) return;
        const double density = link_density(fluids, phi[cell], phi[across]);
        const double weight = std::max(0.0, 1 / density - 1 / small);
        sum += weight * old.at(b, g);
        weights += weight;
      });
      kappa.at(a, f) += nearness * (sum / weights - kappa.at(a, f));
    });
}

// nu/sqrt(sigma h/rho) with the means of both fluids; 0 where the liquid's viscosity is no constant.
template <int Dim>
double grid_ohnesorge(const Domain<Dim>& domain, const Fluids& fluids) {
  const LiquidSpec& liquid = fluids.liquid;
  const Expression mu(liquid.viscosity);
  if (!liquid.rheology.model.empty() || !mu.is_constant()) return 0;
  const double viscosity = mu(Vec3::Zero(), 0) + (fluids.has_gas() ? fluids.gas.viscosity : 0),
               rho = density_at_surface(fluids);
  return viscosity / std::sqrt(rho * liquid.surface_tension * domain.layout.h());
}

// phi a little later, 0.1 of a step, as it has moved before (`steps` times as far in a step): curvature from there
// damps a wave of frequency omega by ahead omega^2 dt/2. The leapfrog of surface and velocity by itself damps nothing,
// and what curvature makes of the grid's irregular crossings would feed waves of a few cells; these have omega dt near
// 1, resolved ones less. Viscosity of nu/sqrt(sigma h/rho) above 0.01 ... 0.02 damps them by itself.
template <int Dim>
CellField<Dim> look_ahead(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& before,
                          const CellField<Dim>& phi, double steps) {
  CellField<Dim> r = phi;
  const double ahead = 0.1 * steps * std::clamp(2 - grid_ohnesorge(domain, fluids) / 0.01, 0.0, 1.0);
  if (ahead == 0) return r;
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) { r[c] += ahead * (phi[c] - before[c]); });
  return r;
}

}  // namespace

template <int Dim>
SurfaceTension<Dim> surface_tension(const Setup<Dim>& s, const StepGeometry<Dim>& g, const CellField<Dim>& before,
                                    const CellField<Dim>& phi, double lead, double dt) {
  SurfaceTension<Dim> r{FaceField<Dim>(s.domain.layout)};
  FaceField<Dim, char> crossed(s.domain.layout);
  const CellField<Dim> continued = continue_at_contact_angle(s.domain, s.fluids, s.solids, g,
                                                             look_ahead(s.domain, s.fluids, before, phi, dt / lead));
  double crossings = 0, by_differences = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(s.domain.layout, s.domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      if ((phi[f - s.domain.layout.stride(a)] < 0) == (phi[f] < 0) || !g.faces.is_unknown(a, f)) return;
      const SurfaceCurvature kappa = curvature_at_crossing<Dim>(s.domain.layout, continued, a, f);
      crossed.at(a, f) = 1;
      r.jump.at(a, f) = kappa.value;
      ++crossings;
      by_differences += kappa.source == CurvatureSource::differences;
    });
  r.crossings = std::int64_t(s.domain.ranks.global_sum(crossings));
  r.by_differences = std::int64_t(s.domain.ranks.global_sum(by_differences));
  s.domain.halo.fill_ghosts(crossed);
  s.domain.halo.fill_ghosts(r.jump);
  agree_in_slivers(s.domain, s.fluids, phi, crossed, r.jump);
  filter_for_step(s.domain, s.fluids, phi, crossed, dt, r.jump);
  balance_closed_pieces(s.domain, g.faces, phi, crossed, r.jump);
  const double sigma = s.perturbation.surface_tension * s.fluids.liquid.surface_tension;
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.domain.layout, s.domain.layout.faces(a), [&](Site f) { r.jump.at(a, f) *= sigma; });
  s.domain.halo.fill_ghosts(r.jump);
  return r;
}

template <int Dim>
double capillary_step(const Domain<Dim>& domain, const Fluids& fluids) {
  const LiquidSpec& liquid = fluids.liquid;
  if (!fluids.has_surface_tension() || liquid.tension_scheme == TensionScheme::semi_implicit)
    return std::numeric_limits<double>::infinity();
  const double h = domain.layout.h();
  return std::sqrt(density_at_surface(fluids) * h * h * h / (4 * pi * liquid.surface_tension));
}

#define SEICHE_INSTANTIATE(D)                                                                                 \
  template SurfaceTension<D> surface_tension<D>(const Setup<D>&, const StepGeometry<D>&, const CellField<D>&, \
                                                const CellField<D>&, double, double);                         \
  template double capillary_step<D>(const Domain<D>&, const Fluids&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
