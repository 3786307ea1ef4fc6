#include "coupling/transport/viscous_transport.h"

#include "base/expression.h"
#include "coupling/state/features.h"
#include "fluid/boundary/inflow.h"
#include "grid/loops.h"
#include "levelset/extrapolate.h"

namespace seiche {
namespace {

template <int Dim>
bool has_uniform_viscosity(const Setup<Dim>& s) {
  const LiquidSpec& liquid = s.scene.liquid;
  return liquid.rheology.model.empty() && Expression(liquid.viscosity).is_constant();
}

bool is_known_and_sticks(const SolidSpec& solid) {
  return !solid.kind.is_free() && solid.slip == Slip::no_slip;
}

}  // namespace

template <int Dim>
bool has_surface(const Setup<Dim>& s, const CellField<Dim>& phi) {
  bool air = false;
  for_each_index_in_order(s.layout, s.layout.cells(), [&](Site c, const IVec<Dim>&) { air = air || phi[c] >= 0; });
  return s.ranks.any(air);
}

template <int Dim>
ViscousPlan plan_viscosity(const Setup<Dim>& s, const State<Dim>& state, const CellField<Dim>& phi, double dt) {
  constexpr double stiff = 0.5;
  ViscousPlan plan;
  if (!s.is_viscous() || s.has_gas() || s.scene.time.scheme == TimeScheme::first_order) return plan;
  plan.full = !has_surface(s, phi);
  const bool known = state.before && dt <= 2 * state.dt_now && dt * state.viscous_rate <= stiff;
  if (plan.full && known && causes_against(s, Feature::shared_viscosity).empty()) plan.implicit = 9.0 / 16;
  return plan;
}

template <int Dim>
bool sticks_to_known_solids(const Setup<Dim>& s) {
  return s.is_viscous() && std::any_of(s.bodies.begin(), s.bodies.end(),
                                       [](const Body<Dim>& body) { return is_known_and_sticks(body.spec()); });
}

template <int Dim>
FaceField<Dim, char> faces_known_to_transport(const Setup<Dim>& s, const StepGeometry<Dim>& g,
                                              const FaceField<Dim, char>& valid) {
  FaceField<Dim, char> known = valid;
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.layout, s.layout.faces(a), [&](Site f) {
      if (known.at(a, f) || g.faces.open.at(a, f) > 0 || g.body[f] < 0) return;
      if (is_known_and_sticks(s.bodies[std::size_t(g.body[f])].spec())) known.at(a, f) = 1;
    });
  s.halo.fill_ghosts(known);
  return known;
}

template <int Dim>
FaceField<Dim, char> uncut_faces(const Setup<Dim>& s, const StepGeometry<Dim>& g, const FaceField<Dim, char>& valid) {
  FaceField<Dim, char> uncut = valid;
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.layout, s.layout.faces(a), [&](Site f) {
      if (g.faces.kind_at(a, f) != FaceKind::prescribed && g.faces.open.at(a, f) < 1) uncut.at(a, f) = 0;
    });
  s.halo.fill_ghosts(uncut);
  return uncut;
}

template <int Dim>
void continue_into_solids(const Setup<Dim>& s, const FaceField<Dim, char>& valid, FaceField<Dim>& f) {
  for (int a = 0; a < Dim; ++a) {
    std::vector<char> known = valid[a];
    extrapolate(s.layout, s.halo, s.layout.faces(a), {s.extrapolated_layers(), 2}, f[a], known);
  }
  fill_velocity_ghosts(s.layout, s.halo, s.sides, f);
}

template <int Dim>
FaceField<Dim> points_of_means(const Setup<Dim>& s, const FaceField<Dim, char>& whole, const FaceField<Dim>& u,
                               double t) {
  FaceField<Dim> points = u;
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.layout, s.layout.faces(a), [&](Site f) {
      if (whole.at(a, f)) points.at(a, f) -= excess_of_mean(s.layout, u, a, f);
    });
  fill_velocity_ghosts(s.layout, s.halo, s.sides, points);
  continue_beyond_walls(s.layout, s.sides, t, FaceValues::points, points);
  continue_beyond_inflows(s.layout, s.sides, t, points);
  return points;
}

template <int Dim>
void add_missing_viscosity(const Setup<Dim>& s, const State<Dim>& state, const FaceField<Dim, char>& whole,
                           const FaceField<Dim>& now, double dt, FaceField<Dim>& u) {
  if (!has_uniform_viscosity(s)) return;
  const double reach = state.viscous_rate * dt;  // mu dt/(rho h^2)
  for (int a = 0; a < Dim; ++a)
    for_each_index(s.layout, s.layout.faces(a), [&](Site f, const IVec<Dim>& i) {
      if (whole.at(a, f)) u.at(a, f) += reach * missing_laplacian(s.layout, s.sides, now, a, f, i);
    });
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template bool has_surface<D>(const Setup<D>&, const CellField<D>&);                                                \
  template ViscousPlan plan_viscosity<D>(const Setup<D>&, const State<D>&, const CellField<D>&, double);             \
  template bool sticks_to_known_solids<D>(const Setup<D>&);                                                          \
  template FaceField<D, char> faces_known_to_transport<D>(const Setup<D>&, const StepGeometry<D>&,                   \
                                                          const FaceField<D, char>&);                                \
  template FaceField<D, char> uncut_faces<D>(const Setup<D>&, const StepGeometry<D>&, const FaceField<D, char>&);    \
  template void continue_into_solids<D>(const Setup<D>&, const FaceField<D, char>&, FaceField<D>&);                  \
  template FaceField<D> points_of_means<D>(const Setup<D>&, const FaceField<D, char>&, const FaceField<D>&, double); \
  template void add_missing_viscosity<D>(const Setup<D>&, const State<D>&, const FaceField<D, char>&,                \
                                         const FaceField<D>&, double, FaceField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
