#include "coupling/transport/two_fluids.h"

#include "coupling/state/fluids.h"
#include "coupling/transport/filling.h"
#include "fluid/boundary/domain.h"
#include "fluid/viscosity/viscous_shares.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// True if a face belongs to the gas: by the fluid that it was solved for, else by phi.
template <int Dim>
bool is_gas_face(const TimeLevel<Dim>& liquid, const TimeLevel<Dim>& gas, const CellField<Dim>& phi, Site stride,
                 int axis, Site f) {
  if (liquid.valid.at(axis, f)) return false;
  return gas.valid.at(axis, f) || phi[f] + phi[f - stride] >= 0;
}

// On each face the `field` of the fluid there. Ghosts filled. Collective.
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

// Reynolds number of a cell, (U + sqrt(sigma/(rho h))) h/nu: cells that the flow and the shortest capillary wave cross
// while viscosity smooths one cell. nu is the smaller of both, rho the sum. Infinite if the liquid's viscosity is not
// constant or nu is 0. Also infinite without tension, since viscosity alone would let the surface roll up. Collective.
template <int Dim>
double reynolds_number_of_cell(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  const LiquidSpec& liquid = fluids.liquid;
  const double none = std::numeric_limits<double>::infinity(), h = domain.layout.h();
  if (!fluids.constant_viscosity()) return none;
  const double nu =
      std::min(*fluids.constant_viscosity() / fluids.density(), fluids.gas_viscosity() / fluids.gas_density());
  if (nu == 0 || liquid.surface_tension == 0) return none;
  return (fastest_component(domain, state) +
          std::sqrt(liquid.surface_tension / ((fluids.density() + fluids.gas_density()) * h))) *
         h / nu;
}

// 1 where viscosity makes both fluids one flow on the scale of the grid, 0 where they may slip along each other.
// Collective.
template <int Dim>
double share_of_both(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  constexpr double resolved = 10;
  return std::clamp(2 - reynolds_number_of_cell(domain, fluids, state) / resolved, 0.0, 1.0);
}

}  // namespace

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

bool flow_as_one(const Fluids& fluids) {
  constexpr double alike = 4;
  if (fluids.liquid.surface_tension > 0) return false;
  return std::max(fluids.density(), fluids.gas_density()) <= alike * std::min(fluids.density(), fluids.gas_density());
}

template <int Dim>
Flow<Dim> flow_of_both(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  const auto join = [&](const auto& liquid, const auto& gas) {
    return level_of_both(domain, fluids, state.phi, liquid, gas);
  };
  const Flow<Dim>& gas = state.exterior->flow;
  return {join(state.now, gas.now), join(state.before, gas.before), join(state.earlier, gas.earlier)};
}

template <int Dim>
FaceField<Dim> flow_at_surface(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state) {
  const TimeLevel<Dim>& of_gas = *state.exterior->flow.now;
  if (flow_as_one(fluids)) return of_levels(domain, state.phi, *state.now, of_gas, &TimeLevel<Dim>::u);
  FaceField<Dim> u = state.now->u;
  const double share = share_of_both(domain, fluids, state);
  if (share == 0) return u;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.padded(),
                  [&](Site f) { u.at(a, f) += 0.5 * share * (of_gas.u.at(a, f) - u.at(a, f)); });
  return u;
}

template <int Dim>
FaceField<Dim> flow_of_volumes(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, double span) {
  const TimeLevel<Dim>& gas = *state.exterior->flow.now;
  const FaceField<Dim> joined = of_levels(domain, state.phi, *state.now, gas, &TimeLevel<Dim>::u);
  const double share = flow_as_one(fluids) ? 1 : share_of_both(domain, fluids, state);
  if (share == 1) return joined;
  FaceField<Dim> u = joined;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.padded(),
                  [&](Site f) { u.at(a, f) = share * joined.at(a, f) + (1 - share) * state.now->u.at(a, f); });
  for (const Site c : overfull_cells<Dim>(domain, {state.liquid, u, Vec3::Zero(), span, state.room()}, u, state.phi))
    for (int a = 0; a < Dim; ++a)
      for (const Site f : {c, c + domain.layout.stride(a)}) u.at(a, f) = joined.at(a, f);
  domain.halo.fill_ghosts(u);
  return u;
}

namespace {

// Viscosities of both fluids side by side and in layers.
struct Mixture {
  double liquid, gas;
  bool in_layers;  // false: the mean by shares alone

  // `layered`: the part of the strain that shears along the surface. Stress is the same in both fluids there, and
  // strain in the rest.
  double mean(double share, double layered) const {
    const double beside = share * liquid + (1 - share) * gas;
    if (!in_layers || share <= 0 || share >= 1) return beside;
    const double across = std::min(liquid, gas) > 0 ? 1 / (share / liquid + (1 - share) / gas) : 0;
    return beside + layered * (across - beside);
  }
};

// Squares of the components of the unit vector along g.
template <int Dim>
Vec<Dim> squared_normal(const Vec<Dim>& g) {
  const double norm = g.squaredNorm();
  return norm > 0 ? Vec<Dim>(g.cwiseAbs2() / norm) : Vec<Dim>(Vec<Dim>::Constant(1.0 / Dim));
}

// With D the strain of an edge, e_a e_b' + e_b e_a', and the normal n: |D n - (n'D n) n|^2 over |D|^2/2.
template <int Dim>
double layered_part_of_edge(const Vec<Dim>& n2, int a, int b) {
  return n2[a] + n2[b] - 4 * n2[a] * n2[b];
}

// The same with e_a e_a' - e_b e_b', the strain of a cell; mean over its planes.
template <int Dim>
double layered_part_of_cell(const Vec<Dim>& n2) {
  double sum = 0;
  for (int p = 0; p < planes<Dim>; ++p) {
    const auto [a, b] = plane_axes<Dim>(p);
    sum += n2[a] + n2[b] - (n2[a] - n2[b]) * (n2[a] - n2[b]);
  }
  return sum / planes<Dim>;
}

// Gradient at a cell's centre, times 2h.
template <int Dim>
Vec<Dim> differences_at(const Layout<Dim>& layout, const CellField<Dim>& phi, Site c) {
  Vec<Dim> g;
  for (int a = 0; a < Dim; ++a) g[a] = phi[c + layout.stride(a)] - phi[c - layout.stride(a)];
  return g;
}

}  // namespace

template <int Dim>
void mix_gas_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, CellField<Dim>& cell,
                       EdgeField<Dim>& edge) {
  const Layout<Dim>& layout = domain.layout;
  const double gas = fluids.gas.viscosity, h = layout.h();
  const bool in_layers = !fluids.has_surface_tension();
  for_each_site(layout, layout.grown(1), [&](Site c) {
    for (int p = 0; p < planes<Dim>; ++p) {
      const auto [a, b] = plane_axes<Dim>(p);
      const std::array<Site, 4> around{c, c - layout.stride(a), c - layout.stride(b),
                                       c - layout.stride(a) - layout.stride(b)};
      double at = 0;
      Vec<Dim> g = Vec<Dim>::Zero();
      for (const Site s : around) at += 0.25 * phi[s], g += differences_at(layout, phi, s);
      double& mu = edge[p][std::size_t(c)];
      mu = Mixture{mu, gas, in_layers}.mean(liquid_share_at(at, h),
                                            layered_part_of_edge<Dim>(squared_normal<Dim>(g), a, b));
    }
  });
  for_each_site(layout, layout.grown(2), [&](Site c) {
    const Vec<Dim> n2 = squared_normal<Dim>(differences_at(layout, phi, c));
    cell[c] = Mixture{cell[c], gas, in_layers}.mean(liquid_share_at(phi[c], h), layered_part_of_cell<Dim>(n2));
  });
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template FaceField<D> flow_at_surface<D>(const Domain<D>&, const Fluids&, const State<D>&);                         \
  template FaceField<D> flow_of_volumes<D>(const Domain<D>&, const Fluids&, const State<D>&, double);                 \
  template Flow<D> flow_of_both<D>(const Domain<D>&, const Fluids&, const State<D>&);                                 \
  template std::shared_ptr<const TimeLevel<D>> level_of_both<D>(const Domain<D>&, const Fluids&, const CellField<D>&, \
                                                                const std::shared_ptr<const TimeLevel<D>>&,           \
                                                                const std::shared_ptr<const TimeLevel<D>>&);          \
  template void mix_gas_viscosity<D>(const Domain<D>&, const Fluids&, const CellField<D>&, CellField<D>&,             \
                                     EdgeField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
