#include "coupling/transport/viscous_memory.h"

#include "base/time_spec.h"
#include "coupling/transport/restore.h"
#include "fluid/transport/advection.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Fraction of the trend of N, the viscous acceleration, that viscous_memory() uses. If viscosity is stiff, N is large
// and almost balanced by pressure. A trend known in only part of the liquid disturbs this balance and amplifies itself.
// The fraction is 1 up to mu dt/(rho h^2) = 1/2 and 0 from 1 on, or 1 if all of the liquid is interior and no solid is
// within reach. Collective.
template <int Dim>
double trust_in_viscous_trend(const Domain<Dim>& domain, const State<Dim>& state, const FaceField<Dim, char>& liquid,
                              double dt) {
  bool partial = false;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      const bool wet = state.phi[f] < 0 || state.phi[f - domain.layout.stride(a)] < 0 || state.exterior->flows();
      partial = partial || (wet && !liquid.at(a, f));
    });
  return domain.ranks.any(partial) ? std::clamp(2 - 2 * dt * state.viscous_rate, 0.0, 1.0) : 1;
}

}  // namespace

template <int Dim>
FaceField<Dim> viscous_memory(const Domain<Dim>& domain, const Fluids& fluids, TimeScheme scheme,
                              const State<Dim>& state, const Flow<Dim>& flow, const FaceField<Dim, char>& interior,
                              double dt, const ViscousPlan& plan) {
  FaceField<Dim> memory(domain.layout);
  if (!fluids.is_viscous() || !flow.before || scheme == TimeScheme::first_order) return memory;
  if (dt > 2 * state.dt_now) return memory;
  const double trust = trust_in_viscous_trend(domain, state, interior, dt);
  if (trust == 0) return memory;
  const double earlier = (plan.implicit == 1 ? trust : 2 * plan.implicit - 1) * dt / (2 * state.dt_now),
               present = 1 - plan.implicit - earlier;
  const TimeLevel<Dim>& now = *flow.now;
  FaceField<Dim> last = flow.before->n, carried(domain.layout);
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, last);
  advect_faces(domain.layout, now.u, state.dt_now, interior, interior, last, last, carried);
  const double limit = 0.25 * domain.layout.h() / (dt * dt);  // as for A
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), interior[a].data(), [&](Site f) {
      if (is_solved(now.valid.at(a, f)) && is_solved(flow.before->valid.at(a, f)))
        memory.at(a, f) = dt * std::clamp(present * now.n.at(a, f) + earlier * carried.at(a, f), -limit, limit);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, memory);
  return memory;
}

#define SEICHE_INSTANTIATE(D)                                                                           \
  template FaceField<D> viscous_memory<D>(const Domain<D>&, const Fluids&, TimeScheme, const State<D>&, \
                                          const Flow<D>&, const FaceField<D, char>&, double, const ViscousPlan&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
