#include "coupling/transport/two_fluids.h"

#include "coupling/state/fluids.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/viscous_shares.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Whether a face belongs to the gas: by where it was solved for, else by the surface.
template <int Dim>
bool is_gas_face(const TimeLevel<Dim>& liquid, const TimeLevel<Dim>& gas, const CellField<Dim>& phi, Site stride,
                 int axis, Site f) {
  if (liquid.valid.at(axis, f)) return false;
  return gas.valid.at(axis, f) || phi[f] + phi[f - stride] >= 0;
}

// On each face `field` of the fluid that is there.
template <int Dim>
FaceField<Dim> of_levels(const Domain<Dim>& domain, const CellField<Dim>& phi, const TimeLevel<Dim>& liquid,
                         const TimeLevel<Dim>& gas, FaceField<Dim> TimeLevel<Dim>::*field) {
  FaceField<Dim> r = liquid.*field;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (is_gas_face(liquid, gas, phi, domain.layout.stride(a), a, f)) r.at(a, f) = (gas.*field).at(a, f);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, r);
  return r;
}

// Valid where either is; null without both.
template <int Dim>
std::shared_ptr<const TimeLevel<Dim>> level_of_both(const Domain<Dim>& domain, const Fluids& fluids,
                                                    const CellField<Dim>& phi,
                                                    const std::shared_ptr<const TimeLevel<Dim>>& liquid,
                                                    const std::shared_ptr<const TimeLevel<Dim>>& gas) {
  if (!liquid || !gas) return {};
  auto r = std::make_shared<TimeLevel<Dim>>(*liquid);
  r->u = of_levels(domain, phi, *liquid, *gas, &TimeLevel<Dim>::u);
  r->q = of_levels(domain, phi, *liquid, *gas, &TimeLevel<Dim>::q);
  if (fluids.is_viscous()) r->n = of_levels(domain, phi, *liquid, *gas, &TimeLevel<Dim>::n);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.padded(), [&](Site f) {
      if (!r->valid.at(a, f)) r->valid.at(a, f) = gas->valid.at(a, f);
    });
  return r;
}

// (U + sqrt(sigma/(rho h))) h/nu: how far the flow, and the shortest capillary wave, go in the time in which viscosity
// evens out a cell; nu the smaller one. Infinite where viscosity is no constant, and without tension, which shapes a
// surface that viscosity alone would leave to roll up. Collective.
template <int Dim>
double reynolds_number_of_cell(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  const LiquidSpec& liquid = fluids.liquid;
  const Expression mu(liquid.viscosity);
  const double none = std::numeric_limits<double>::infinity(), h = domain.layout.h();
  if (!liquid.rheology.model.empty() || !mu.is_constant()) return none;
  const double nu = std::min(mu(Vec3::Zero(), 0) / fluids.density(), fluids.gas.viscosity / fluids.gas_density());
  if (nu == 0 || liquid.surface_tension == 0) return none;
  return (fastest_component(domain, state) +
          std::sqrt(liquid.surface_tension / ((fluids.density() + fluids.gas_density()) * h))) *
         h / nu;
}

}  // namespace

template <int Dim>
FaceField<Dim> of_both(const Domain<Dim>& domain, const State<Dim>& state, FaceField<Dim> TimeLevel<Dim>::*field) {
  return state.gas.now ? of_levels(domain, state.phi, *state.now, *state.gas.now, field) : (*state.now).*field;
}

bool flow_as_one(const Fluids& fluids) {
  constexpr double alike = 4;
  if (!fluids.has_gas() || fluids.liquid.surface_tension > 0) return false;
  return std::max(fluids.density(), fluids.gas_density()) <= alike * std::min(fluids.density(), fluids.gas_density());
}

template <int Dim>
Flow<Dim> flow_of_both(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  const auto join = [&](const auto& liquid, const auto& gas) {
    return level_of_both(domain, fluids, state.phi, liquid, gas);
  };
  return {join(state.now, state.gas.now), join(state.before, state.gas.before), join(state.earlier, state.gas.earlier)};
}

template <int Dim>
FaceField<Dim> flow_at_surface(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  if (flow_as_one(fluids)) return of_both(domain, state, &TimeLevel<Dim>::u);
  FaceField<Dim> u = state.now->u;
  if (!fluids.has_gas()) return u;
  constexpr double resolved = 10;
  const double share = std::clamp(2 - reynolds_number_of_cell(domain, fluids, state) / resolved, 0.0, 1.0);
  if (share == 0) return u;
  const FaceField<Dim>& gas = state.gas.now->u;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.padded(),
                  [&](Site f) { u.at(a, f) += 0.5 * share * (gas.at(a, f) - u.at(a, f)); });
  return u;
}

template <int Dim>
void keep_faces(const Layout<Dim>& layout, const FaceField<Dim, char>& marked, TimeLevel<Dim>& level) {
  for (int a = 0; a < Dim; ++a)
    for_each_site(layout, layout.faces(a), [&](Site f) {
      if (marked.at(a, f)) return;
      level.valid.at(a, f) = 0;
      level.u.at(a, f) = level.q.at(a, f) = 0;
    });
}

template <int Dim>
void mix_gas_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, CellField<Dim>& cell,
                       EdgeField<Dim>& edge) {
  const double gas = fluids.gas.viscosity, h = domain.layout.h();
  const auto mean = [&](double share, double liquid) { return share * liquid + (1 - share) * gas; };
  for_each_site(domain.layout, domain.layout.grown(1), [&](Site c) {
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      const Site da = domain.layout.stride(a), db = domain.layout.stride(b);
      const double at = 0.25 * (phi[c] + phi[c - da] + phi[c - db] + phi[c - da - db]);
      double& mu = edge[p][std::size_t(c)];
      mu = mean(liquid_share_at(at, h), mu);
    }
  });
  for_each_site(domain.layout, domain.layout.grown(2),
                [&](Site c) { cell[c] = mean(liquid_share_at(phi[c], h), cell[c]); });
}

#define SEICHE_INSTANTIATE(D)                                                                             \
  template FaceField<D> flow_at_surface<D>(const Domain<D>&, const Fluids&, const State<D>&);             \
  template Flow<D> flow_of_both<D>(const Domain<D>&, const Fluids&, const State<D>&);                     \
  template FaceField<D> of_both<D>(const Domain<D>&, const State<D>&, FaceField<D> TimeLevel<D>::*);      \
  template void keep_faces<D>(const Layout<D>&, const FaceField<D, char>&, TimeLevel<D>&);                \
  template void mix_gas_viscosity<D>(const Domain<D>&, const Fluids&, const CellField<D>&, CellField<D>&, \
                                     EdgeField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
