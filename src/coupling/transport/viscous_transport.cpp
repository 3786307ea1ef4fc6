#include "coupling/transport/viscous_transport.h"

#include "base/expression.h"
#include "base/time_spec.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "fluid/boundary/domain.h"
#include "fluid/boundary/inflow.h"
#include "grid/loops.h"

namespace seiche {
template <int Dim>
bool has_surface(const Domain<Dim>& domain, const CellField<Dim>& phi) {
  bool air = false;
  for_each_index_in_order(domain.layout, domain.layout.cells(),
                          [&](Site c, const IVec<Dim>&) { air = air || phi[c] >= 0; });
  return domain.ranks.any(air);
}

template <int Dim>
ViscousPlan plan_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                           const Features& features, const State<Dim>& state, const CellField<Dim>& phi, double dt) {
  constexpr double stiff = 0.5;
  ViscousPlan plan;
  if (!fluids.is_viscous() || state.exterior->flows() || time.scheme == TimeScheme::first_order) return plan;
  plan.full = !has_surface(domain, phi);
  const bool known = state.before && dt <= 2 * state.dt_now && dt * state.viscous_rate <= stiff;
  if (plan.full && known && features.has(Feature::shared_viscosity)) plan.implicit = 9.0 / 16;
  return plan;
}

template <int Dim>
FaceField<Dim, char> uncut_faces(const Domain<Dim>& domain, const StepGeometry<Dim>& g,
                                 const FaceField<Dim, char>& valid) {
  FaceField<Dim, char> uncut = valid;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (g.faces.kind_at(a, f) != FaceKind::prescribed && g.faces.open.at(a, f) < 1) uncut.at(a, f) = 0;
    });
  domain.halo.fill_ghosts(uncut);
  return uncut;
}

template <int Dim>
FaceField<Dim> points_of_means(const Domain<Dim>& domain, const FaceField<Dim, char>& whole, const FaceField<Dim>& u,
                               double t) {
  FaceField<Dim> points = u;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (whole.at(a, f)) points.at(a, f) -= excess_of_mean(domain.layout, u, a, f);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, points);
  continue_beyond_walls(domain.layout, domain.sides, t, FaceValues::points, points);
  continue_beyond_inflows(domain.layout, domain.sides, t, points);
  return points;
}

template <int Dim>
double add_missing_viscosity(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                             const FaceField<Dim, char>& whole, const FaceField<Dim>& now, double dt,
                             FaceField<Dim>& u) {
  if (!fluids.constant_viscosity()) return 0;
  const double reach = state.viscous_rate * dt;  // mu dt/(rho h^2)
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    sum += local_sum(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (!whole.at(a, f)) return 0.0;
      const double added = reach * missing_laplacian(domain.layout, domain.sides, now, a, f, i);
      u.at(a, f) += added;
      return added * state.now->u.at(a, f);
    });
  return fluids.density() * domain.layout.geometry().cell_volume() * domain.ranks.global_sum(sum) / dt;
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template bool has_surface<D>(const Domain<D>&, const CellField<D>&);                                                \
  template ViscousPlan plan_viscosity<D>(const Domain<D>&, const Fluids&, const TimeSpec&, const Features&,           \
                                         const State<D>&, const CellField<D>&, double);                               \
  template FaceField<D, char> uncut_faces<D>(const Domain<D>&, const StepGeometry<D>&, const FaceField<D, char>&);    \
  template FaceField<D> points_of_means<D>(const Domain<D>&, const FaceField<D, char>&, const FaceField<D>&, double); \
  template double add_missing_viscosity<D>(const Domain<D>&, const Fluids&, const State<D>&,                          \
                                           const FaceField<D, char>&, const FaceField<D>&, double, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
