#include "coupling/tension/surface_tension.h"

#include <numbers>

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

// Sum of both densities: the inertia of capillary waves.
double density_at_surface(const Fluids& fluids) {
  return fluids.density() + fluids.gas_density();
}

// Filters kappa if the scheme is semi-implicit and the step too long for explicit tension. Collective.
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

// Averages kappa over links that the surface crosses next to the centre of their liquid cell. Such links cross it at
// about the same point, but errors of their jumps act on almost massless faces. The flow through the cell would gain
// rho/rho_f times that error. In a drop that oscillates at 0.4 m/s it reached 15 m/s for one step. Below rho_f/rho =
// 1/50, kappa goes over to a mean of such links of the cell, weighted by rho/rho_f - 50. On other links kappa varies
// along the surface, and that accelerates the liquid along it. Halos of kappa and crossed must be filled.
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

// Ohnesorge number of a cell, nu/sqrt(sigma h/rho), with the sums of both viscosities and densities. 0 if the liquid's
// viscosity is not constant.
template <int Dim>
double grid_ohnesorge(const Domain<Dim>& domain, const Fluids& fluids) {
  const LiquidSpec& liquid = fluids.liquid;
  if (!fluids.constant_viscosity()) return 0;
  const double viscosity = *fluids.constant_viscosity() + fluids.gas_viscosity(), rho = density_at_surface(fluids);
  return viscosity / std::sqrt(rho * liquid.surface_tension * domain.layout.h());
}

// phi extrapolated by 0.1 of a step from its last motion; `steps`: dt over the time since `before`. Curvature of that
// phi damps a wave of frequency omega at the rate ahead omega^2 dt/2. The leapfrog of surface and velocity has no
// damping itself. Errors of curvature at the irregular crossings of the grid would feed waves of a few cells. These
// have omega dt near 1, resolved ones less. The extrapolation fades out for grid_ohnesorge() from 0.01 to 0.02, where
// viscosity damps such waves.
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
SurfaceTension<Dim> surface_tension(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                                    const OperatorPerturbation& perturbation, const StepGeometry<Dim>& g,
                                    const CellField<Dim>& before, const CellField<Dim>& phi, double lead, double dt) {
  SurfaceTension<Dim> r{FaceField<Dim>(domain.layout)};
  FaceField<Dim, char> crossed(domain.layout);
  const CellField<Dim> continued =
      continue_at_contact_angle(domain, fluids, solids, g, look_ahead(domain, fluids, before, phi, dt / lead));
  double crossings = 0, by_differences = 0;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      if ((phi[f - domain.layout.stride(a)] < 0) == (phi[f] < 0) || !g.faces.is_unknown(a, f)) return;
      const SurfaceCurvature kappa = curvature_at_crossing<Dim>(domain.layout, continued, a, f);
      crossed.at(a, f) = 1;
      r.jump.at(a, f) = kappa.value;
      ++crossings;
      by_differences += kappa.source == CurvatureSource::differences;
    });
  r.crossings = std::int64_t(domain.ranks.global_sum(crossings));
  r.by_differences = std::int64_t(domain.ranks.global_sum(by_differences));
  domain.halo.fill_ghosts(crossed);
  domain.halo.fill_ghosts(r.jump);
  agree_in_slivers(domain, fluids, phi, crossed, r.jump);
  filter_for_step(domain, fluids, phi, crossed, dt, r.jump);
  balance_closed_pieces(domain, fluids, g.faces, phi, crossed, r.jump);
  const double sigma = perturbation.surface_tension * fluids.liquid.surface_tension;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) { r.jump.at(a, f) *= sigma; });
  domain.halo.fill_ghosts(r.jump);
  return r;
}

template <int Dim>
double capillary_step(const Domain<Dim>& domain, const Fluids& fluids) {
  const LiquidSpec& liquid = fluids.liquid;
  if (!fluids.has_surface_tension() || liquid.tension_scheme == TensionScheme::semi_implicit)
    return std::numeric_limits<double>::infinity();
  const double h = domain.layout.h();
  return std::sqrt(density_at_surface(fluids) * h * h * h / (4 * std::numbers::pi * liquid.surface_tension));
}

#define SEICHE_INSTANTIATE(D)                                                                              \
  template SurfaceTension<D> surface_tension<D>(const Domain<D>&, const Fluids&, const Solids<D>&,         \
                                                const OperatorPerturbation&, const StepGeometry<D>&,       \
                                                const CellField<D>&, const CellField<D>&, double, double); \
  template double capillary_step<D>(const Domain<D>&, const Fluids&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
