#include "coupling/transport/transport.h"

#include "base/time_spec.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/level_in_solids.h"
#include "coupling/transport/path_origins.h"
#include "coupling/transport/restore.h"
#include "coupling/transport/shear_jump.h"
#include "coupling/transport/sources.h"
#include "coupling/transport/two_fluids.h"
#include "coupling/transport/viscous_transport.h"
#include "fluid/boundary/domain.h"
#include "fluid/boundary/inflow.h"
#include "fluid/transport/advection.h"
#include "grid/loops.h"
#include "levelset/fractions.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Lagrange weights that carry values at t, t - dt1, t - dt1 - dt2 to t + dt/2.
std::array<double, 3> half_step_weights(double dt, double dt1, double dt2) {
  const double tau = dt / 2;
  if (dt2 == 0) return {1 + tau / dt1, -tau / dt1, 0};
  return {(tau + dt1) * (tau + dt1 + dt2) / (dt1 * (dt1 + dt2)), -tau * (tau + dt1 + dt2) / (dt1 * dt2),
          tau * (tau + dt1) / ((dt1 + dt2) * dt2)};
}

// 1 where every face that transport may read from is known: higher order needs whole stencils.
template <int Dim>
FaceField<Dim, char> interior_faces(const Domain<Dim>& domain, const FaceField<Dim, char>& known) {
  const int reach = domain.layout.halo() - 1;  // a step's path and half a stencil
  FaceField<Dim, char> interior = known;
  for (int a = 0; a < Dim; ++a)
    for (int axis = 0; axis < Dim; ++axis) {
      const std::vector<char> old = interior[a];
      Box<Dim> box = domain.layout.faces(a);
      for (int later = axis + 1; later < Dim; ++later) box.lower[later] -= reach, box.upper[later] += reach;
      for_each_index(domain.layout, box.cut(domain.layout.padded()), [&](Site f, const IVec<Dim>& i) {
        interior.at(a, f) = old[f] == 0 ? 0 : least_along(domain.layout, old, a, axis, reach, f, i);
      });
    }
  return interior;
}

// w = u(t + dt/2), extrapolated from up to three levels within the liquid; elsewhere the present u.
template <int Dim>
FaceField<Dim> path_velocity(const Domain<Dim>& domain, const TimeSpec& time, const State<Dim>& state,
                             const Flow<Dim>& flow, const FaceField<Dim, char>& interior, const ViscousPlan& plan,
                             double dt) {
  FaceField<Dim> w = flow.now->u;
  if (plan.full) continue_beyond_walls(domain.layout, domain.sides, state.time, FaceValues::means, w);
  continue_beyond_inflows(domain.layout, domain.sides, state.time, w);
  let_air_follow(domain.layout, domain.sides, state.time, flow.now->valid, w);
  if (!flow.before || time.scheme == TimeScheme::first_order) return w;
  if (dt > 2 * state.dt_now) return w;  // weights grow with the ratio of steps, noise with them
  const bool three = flow.earlier != nullptr && state.dt_now <= 2 * state.dt_before;
  const auto c = half_step_weights(dt, state.dt_now, three ? state.dt_before : 0);
  const TimeLevel<Dim>&l0 = *flow.now, &l1 = *flow.before, &l2 = three ? *flow.earlier : *flow.before;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (interior.at(a, f) && l1.valid.at(a, f) && l2.valid.at(a, f))
        w.at(a, f) = c[0] * l0.u.at(a, f) + c[1] * l1.u.at(a, f) + c[2] * l2.u.at(a, f);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, w);
  if (plan.full) continue_beyond_walls(domain.layout, domain.sides, state.time + dt / 2, FaceValues::means, w);
  continue_beyond_inflows(domain.layout, domain.sides, state.time + dt / 2, w);
  let_air_follow(domain.layout, domain.sides, state.time + dt / 2, flow.now->valid, w);
  return w;
}

// One pass of the (1, 2, 1)/4 filter along every axis.
template <int Dim>
void smooth(const Domain<Dim>& domain, FaceField<Dim>& f) {
  for (int axis = 0; axis < Dim; ++axis) {
    const FaceField<Dim> old = f;
    const Site d = domain.layout.stride(axis);
    for (int a = 0; a < Dim; ++a)
      for_each_site(domain.layout, domain.layout.faces(a),
                    [&](Site c) { f.at(a, c) = 0.25 * (old.at(a, c - d) + 2 * old.at(a, c) + old.at(a, c + d)); });
    fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, f);
  }
}

// Trend of the pressure slope from t - dt_now/2 to t + dt/2. Carrying it on as it stands grows waves that the flow
// takes more than about an eighth of their length a step: errors follow r^2 = c ((1 + F) r - F), c = (1 - exp(-i
// theta))/2, F the filter's response. 2 c^2 passes keep |r| <= 1 up to Courant number c = 2; beyond it the trend is
// left out.
template <int Dim>
FaceField<Dim> slope_trend(const Domain<Dim>& domain, const State<Dim>& state, const Flow<Dim>& flow, double dt) {
  FaceField<Dim> trend(domain.layout);
  if (!flow.before || state.dt_before == 0 || dt > 2 * state.dt_now) return trend;
  const double courant = fastest_component(domain, state) * dt / domain.layout.h();
  if (courant > 2) return trend;
  const TimeLevel<Dim>&l0 = *flow.now, &l1 = *flow.before;
  const double ratio = (dt + state.dt_now) / (state.dt_now + state.dt_before);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (l0.valid.at(a, f) == face_solved && l1.valid.at(a, f) == face_solved)
        trend.at(a, f) = ratio * (l0.q.at(a, f) - l1.q.at(a, f));
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, trend);
  for (int n = 0; n < std::ceil(2 * courant * courant); ++n) smooth(domain, trend);
  return trend;
}

// A = f - G: the acceleration of the liquid at t + dt/2, G the pressure slope with its trend carried on. All zero at
// the start and in first order. Impacts change velocity at once whatever dt is, so that their A says nothing of the
// next step: |A| dt^2 <= h/4 keeps them out and leaves resolved flow alone (A dt^2/h is of order h there).
template <int Dim>
FaceField<Dim> acceleration(const Setup<Dim>& s, const State<Dim>& state, const Flow<Dim>& flow, double dt) {
  FaceField<Dim> acc(s.domain.layout);
  if (state.dt_now == 0 || s.scene.time.scheme == TimeScheme::first_order) return acc;
  const FaceField<Dim> trend = slope_trend(s.domain, state, flow, dt);
  const TimeLevel<Dim>& level = *flow.now;
  const Vec3 g = s.perturbation.gravity * s.fluids.gravity.of_step(state.time + dt, dt);
  const double limit = 0.25 * s.domain.layout.h() / (dt * dt);
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.domain.layout, s.domain.layout.faces(a), [&](Site f) {
      if (level.valid.at(a, f) == face_solved)
        acc.at(a, f) = std::clamp(g[a] - level.q.at(a, f) - trend.at(a, f), -limit, limit);
    });
  fill_velocity_ghosts(s.domain.layout, s.domain.halo, s.domain.sides, acc);
  return acc;
}

// How much of the trend of N can be used. Where viscosity is stiff, N is large and all but balanced by pressure; a
// trend known in part of the liquid alone unbalances them and feeds itself: whole up to mu dt/(rho h^2) = 1/2, none
// from 1 on, unless all of the liquid is interior. Collective.
template <int Dim>
double trust_in_viscous_trend(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                              const FaceField<Dim, char>& interior, double dt) {
  bool partial = false;
  for (int a = 0; a < Dim; ++a)
    for_each_index_in_order(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      const bool wet = state.phi[f] < 0 || state.phi[f - domain.layout.stride(a)] < 0 || fluids.has_gas();
      partial = partial || (wet && !interior.at(a, f));
    });
  return domain.ranks.any(partial) ? std::clamp(2 - 2 * dt * state.viscous_rate, 0.0, 1.0) : 1;
}

// What viscosity did before that the step takes up again, N the acceleration by it, as one of u: c1 N(t + dt) + c2 N(t)
// + c3 N(t - dt_now) along the path with the implicit share c1 is N(t + dt/2) to second order. With c1 = 1 all that
// comes from before is a trend, -dt/(2 dt_now) (N(t) - N(t - dt_now)) as far as it can be trusted. Zero where either is
// not known, and in first order.
template <int Dim>
FaceField<Dim> viscous_memory(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                              const State<Dim>& state, const Flow<Dim>& flow, const FaceField<Dim, char>& interior,
                              double dt, const ViscousPlan& plan) {
  FaceField<Dim> memory(domain.layout);
  if (!fluids.is_viscous() || !flow.before || time.scheme == TimeScheme::first_order) return memory;
  if (dt > 2 * state.dt_now) return memory;
  const double trust = trust_in_viscous_trend(domain, fluids, state, interior, dt);
  if (trust == 0) return memory;
  const double earlier = (plan.implicit == 1 ? trust : 2 * plan.implicit - 1) * dt / (2 * state.dt_now),
               present = 1 - plan.implicit - earlier;
  const TimeLevel<Dim>& now = *flow.now;
  FaceField<Dim> last = flow.before->n, carried(domain.layout);
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, last);
  advect_faces(domain.layout, now.u, state.dt_now, interior, interior, last, last, carried);
  const double limit = 0.25 * domain.layout.h() / (dt * dt);  // as of A
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (interior.at(a, f) && now.valid.at(a, f) == face_solved && flow.before->valid.at(a, f) == face_solved)
        memory.at(a, f) = dt * std::clamp(present * now.n.at(a, f) + earlier * carried.at(a, f), -limit, limit);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, memory);
  return memory;
}

// What is carried along the path: `inner` where all it needs is known, `outer` elsewhere.
template <int Dim>
struct Carried {
  FaceField<Dim> inner, outer;
};

// u(x) <- u(x) + d + the excess of the mean of d over the face, d = I[v](x_d) - v(x), v the velocities at points: what
// flows are means, what paths begin and end at are points.
template <int Dim>
void advect_means(const Domain<Dim>& domain, const OperatorPerturbation& perturbation, const State<Dim>& state,
                  const Carried<Dim>& carried, FaceField<Dim> path, const FaceField<Dim, char>& near,
                  const FaceField<Dim, char>& interior, const FaceField<Dim, char>& whole, double dt,
                  FaceField<Dim>& u) {
  path = points_of_means(domain, whole, path, state.time + dt / 2);
  const FaceField<Dim> v = points_of_means(domain, whole, carried.inner, state.time);
  FaceField<Dim> d(domain.layout);
  advect_faces(domain.layout, path, perturbation.velocity_advection * dt, near, interior, v, carried.outer, u,
               Interpolation::six_points);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (near.at(a, f)) d.at(a, f) = u.at(a, f) - (interior.at(a, f) ? v : carried.outer).at(a, f);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, d);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (!near.at(a, f) || !interior.at(a, f) || !whole.at(a, f)) return;
      u.at(a, f) = carried.inner.at(a, f) + d.at(a, f) + excess_of_mean(domain.layout, d, a, f);
    });
}

// Which faces of a flow transport may read, and what it knows there; geometry is as the solve finds it.
template <int Dim>
struct Surroundings {
  bool enters_solids;                            // velocity is continued into solids that liquid sticks to
  FaceField<Dim, char> interior, liquid, whole;  // liquid: interior without such solids

  Surroundings(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const StepGeometry<Dim>& g,
               const FaceField<Dim, char>& valid, const ViscousPlan& plan)
      : enters_solids(plan.full && sticks_to_known_solids(fluids, solids)),
        interior(interior_faces(domain, enters_solids ? faces_known_to_transport(domain, solids, g, valid) : valid)) {
    liquid = enters_solids ? interior_faces(domain, valid) : interior;
    if (plan.full) whole = whole_faces(domain.layout, domain.sides, uncut_faces(domain, g, valid));
  }
};

// What one fluid's flow brings to the faces near where it is now.
template <int Dim>
FaceField<Dim> transport_flow(const Setup<Dim>& s, const State<Dim>& state, const Flow<Dim>& flow,
                              const FaceField<Dim, char>& near, double dt, const ViscousPlan& plan,
                              const StepGeometry<Dim>& geometry) {
  const Surroundings<Dim> known(s.domain, s.fluids, s.solids, geometry, flow.now->valid, plan);
  const FaceField<Dim, char>& interior = known.interior;
  const FaceField<Dim> path = path_velocity(s.domain, s.scene.time, state, flow, interior, plan, dt);
  FaceField<Dim> acc = acceleration(s, state, flow, dt),
                 memory = viscous_memory(s.domain, s.fluids, s.scene.time, state, flow, known.liquid, dt, plan);
  if (known.enters_solids) continue_into_solids(s.domain, flow.now->valid, acc);
  Carried<Dim> carried{flow.now->u, flow.now->u};
  if (plan.full) continue_beyond_walls(s.domain.layout, s.domain.sides, state.time, FaceValues::means, carried.outer);
  continue_beyond_inflows(s.domain.layout, s.domain.sides, state.time, carried.outer);
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.domain.layout, s.domain.layout.padded(), [&](Site f) {
      carried.inner.at(a, f) = carried.outer.at(a, f) + 0.5 * dt * acc.at(a, f) + memory.at(a, f);
    });
  // Faces beside those near liquid follow the viscous stress.
  FaceField<Dim> u = s.fluids.is_viscous() ? flow.now->u : FaceField<Dim>(s.domain.layout);
  if (plan.full)
    advect_means(s.domain, s.perturbation, state, carried, path, near, interior, known.whole, dt, u);
  else
    advect_faces(s.domain.layout, path, s.perturbation.velocity_advection * dt, near, interior, carried.inner,
                 carried.outer, u);
  const FacePaths<Dim> paths{path, near, s.perturbation.velocity_advection * dt};
  limit_at_surfaces(s.domain, *flow.now, paths, interior, u);
  if (plan.full) add_missing_viscosity(s.domain, s.fluids, state, known.whole, carried.outer, dt, u);
  const Vec3 g = s.perturbation.gravity * s.fluids.gravity.of_step(state.time + dt, dt);
  for (int a = 0; a < Dim; ++a)
    for_each_site(s.domain.layout, s.domain.layout.faces(a), [&](Site f) {
      if (near.at(a, f) || s.fluids.is_viscous())
        u.at(a, f) += dt * (g[a] - (interior.at(a, f) ? 0.5 * acc.at(a, f) : 0));
    });
  let_liquid_in(s, *flow.now, paths, state.time, memory, u);
  return u;
}

// Liquid faces keep u, gas faces take that of the gas; where the surface crosses both momenta add up:
// rho_f u = theta rho u_liquid + (1 - theta) rho_gas u_gas.
template <int Dim>
void join(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi, const FaceField<Dim>& gas,
          FaceField<Dim>& u) {
  const double ratio = fluids.gas_density() / fluids.density();
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      const double theta = liquid_part(phi[f - domain.layout.stride(a)], phi[f]);
      u.at(a, f) = (theta * u.at(a, f) + (1 - theta) * ratio * gas.at(a, f)) / (theta + (1 - theta) * ratio);
    });
}

}  // namespace

double closest_point_band(const Fluids& fluids) {
  return fluids.liquid.surface_tension > 0 || fluids.has_gas() || fluids.has_prescribed_flow() ? 3 : 0;
}

template <int Dim>
double liquid_volume(const Domain<Dim>& domain, const CellField<Dim>& phi, const NodeField<Dim>& psi) {
  return domain.ranks.global_sum(local_liquid_volume(domain.layout, phi, psi));
}

template <int Dim>
double transport_surface(const Setup<Dim>& s, const State<Dim>& state, const FaceField<Dim>& u, double t, double dt,
                         CellField<Dim>& phi) {
  check_forces_of_step(s.domain, s.fluids, s.sources, t, t + dt);
  CellField<Dim> joined = phi;
  if (s.domain.sides.any_inflow())
    join_inflow(s.domain.layout, s.domain.halo, s.domain.ranks, s.domain.sides, t, joined);
  LevelSetTransport how;
  if (s.fluids.has_prescribed_flow()) how.trace = Trace::third_order;                // nothing else errs there
  how.one_sided_at_medial_axis = s.features.has(Feature::one_sided_at_medial_axis);  // docs/decisions/0023-kinks.md
  FaceField<Dim> path = u;
  if (!s.fluids.has_prescribed_flow()) {
    continue_beyond_inflows(s.domain.layout, s.domain.sides, t, path);
    let_air_follow(s.domain.layout, s.domain.sides, t, state.now->valid, path);
  }
  advect_level_set(s.domain.layout, path, s.perturbation.surface_advection * dt, s.domain.band(), joined, phi, how);
  fill_level_set_ghosts(s.domain.layout, s.domain.halo, phi);
  return add_sources(s.domain, s.solids, s.sources, state, t, t + dt, phi);
}

template <int Dim>
void make_distance(const Setup<Dim>& s, const CellField<Dim, char>& closed, CellField<Dim>& phi) {
  const int moved = int(std::ceil(s.scene.time.cfl)) + 1;
  redistance_beside_solids(s.domain, s.solids, closed,
                           {s.domain.band() / s.domain.layout.h(), 6 + 2 * moved, moved, closest_point_band(s.fluids)},
                           1, phi);
}

template <int Dim>
FaceField<Dim, char> faces_near_liquid(const Domain<Dim>& domain, const CellField<Dim>& phi) {
  FaceField<Dim, char> near(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a),
                  [&](Site f) { near.at(a, f) = phi[f] < 0 || phi[f - domain.layout.stride(a)] < 0; });
  return near;
}

template <int Dim>
FaceField<Dim, char> faces_near_gas(const Domain<Dim>& domain, const CellField<Dim>& phi) {
  FaceField<Dim, char> near(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a),
                  [&](Site f) { near.at(a, f) = phi[f] >= 0 || phi[f - domain.layout.stride(a)] >= 0; });
  return near;
}

template <int Dim>
FaceField<Dim> transport_velocity(const Setup<Dim>& s, const State<Dim>& state, const CellField<Dim>& phi, double dt,
                                  const ViscousPlan& plan, const StepGeometry<Dim>& geometry) {
  const bool as_one = flow_as_one(s.fluids);
  const FaceField<Dim, char> near =
      as_one ? FaceField<Dim, char>(s.domain.layout, 1) : faces_near_liquid(s.domain, phi);
  FaceField<Dim> u = transport_flow(s, state, as_one ? flow_of_both(s.domain, s.fluids, state) : liquid_flow(state),
                                    near, dt, plan, geometry);
  if (s.fluids.has_gas() && !as_one)
    join(s.domain, s.fluids, phi,
         transport_flow(s, state, state.gas, faces_near_gas(s.domain, phi), dt, plan, geometry), u);
  if (s.fluids.has_gas()) add_shear_jump(s.domain, s.fluids, s.features, state, phi, dt, u);
  set_source_velocity(s.domain, s.sources, state.time, state.time + dt, u);
  fill_velocity_ghosts(s.domain.layout, s.domain.halo, s.domain.sides, u);
  return u;
}

template <int Dim>
double control_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, double expected, double limit,
                      CellField<Dim>& phi) {
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  const double volume = liquid_volume(domain, phi, psi);
  const double missing = expected - volume, probe = 1e-3 * domain.layout.h();
  CellField<Dim> shifted = phi;
  const auto shift = [&](double by) {
    for_each_site(domain.layout, domain.layout.padded(),
                  [&](Site c) { shifted[c] = std::abs(phi[c]) < domain.band() ? phi[c] - by : phi[c]; });
  };
  shift(probe);
  const double area = (liquid_volume(domain, shifted, psi) - volume) / probe;  // of the free surface
  if (area <= 0) return 0;
  shift(std::clamp(missing / area, -limit, limit));
  phi = shifted;
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  return liquid_volume(domain, phi, psi) - volume;
}

#define SEICHE_INSTANTIATE(D)                                                                                 \
  template double liquid_volume<D>(const Domain<D>&, const CellField<D>&, const NodeField<D>&);               \
  template double transport_surface<D>(const Setup<D>&, const State<D>&, const FaceField<D>&, double, double, \
                                       CellField<D>&);                                                        \
  template void make_distance<D>(const Setup<D>&, const CellField<D, char>&, CellField<D>&);                  \
  template FaceField<D, char> faces_near_liquid<D>(const Domain<D>&, const CellField<D>&);                    \
  template FaceField<D, char> faces_near_gas<D>(const Domain<D>&, const CellField<D>&);                       \
  template FaceField<D> transport_velocity<D>(const Setup<D>&, const State<D>&, const CellField<D>&, double,  \
                                              const ViscousPlan&, const StepGeometry<D>&);                    \
  template double control_volume<D>(const Domain<D>&, const NodeField<D>&, double, double, CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
