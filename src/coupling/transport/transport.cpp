#include "coupling/transport/transport.h"

#include <cstring>
#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/state/features.h"
#include "coupling/state/fluids.h"
#include "coupling/state/operator_perturbation.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "coupling/transport/beside_solids.h"
#include "coupling/transport/carried_acceleration.h"
#include "coupling/transport/flow_through_walls.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/level_in_solids.h"
#include "coupling/transport/path_origins.h"
#include "coupling/transport/reached_sites.h"
#include "coupling/transport/restore.h"
#include "coupling/transport/shear_jump.h"
#include "coupling/transport/sources.h"
#include "coupling/transport/two_fluids.h"
#include "coupling/transport/viscous_memory.h"
#include "coupling/transport/viscous_transport.h"
#include "coupling/transport/wall_viscosity.h"
#include "fluid/boundary/domain.h"
#include "fluid/boundary/inflow.h"
#include "fluid/transport/advection.h"
#include "fluid/viscosity/load_sums.h"
#include "grid/loops.h"
#include "levelset/fractions.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Lagrange weights that extrapolate values at t, t - dt1, t - dt1 - dt2 to t + dt/2. dt2 = 0: first two levels only.
std::array<double, 3> half_step_weights(double dt, double dt1, double dt2) {
  const double tau = dt / 2;
  if (dt2 == 0) return {1 + tau / dt1, -tau / dt1, 0};
  return {(tau + dt1) * (tau + dt1 + dt2) / (dt1 * (dt1 + dt2)), -tau * (tau + dt1 + dt2) / (dt1 * dt2),
          tau * (tau + dt1) / ((dt1 + dt2) * dt2)};
}

// to[n] &= from[n]
void require_all(const char* from, int length, char* to) {
  for (int n = 0; n < length; ++n) to[n] = char(to[n] & from[n]);
}

// to[n] &= (all within `reach` along the row are set), for a row of faces at index i0. Faces beyond the first and the
// last of the domain do not count unless it is periodic.
void require_along_row(const char* from, int i0, int length, int reach, bool periodic, int last, char* to) {
  for (int k = -reach; k <= reach; ++k) {
    const int begin = periodic ? 0 : std::max(0, -k - i0),
              end = periodic ? length : std::min(length, last + 1 - k - i0);
    if (begin < end) require_all(from + begin + k, end - begin, to + begin);
  }
}

// 1 on faces around which all faces within `reach` cells along each axis are known.
template <int Dim>
FaceField<Dim, char> faces_within(const Domain<Dim>& domain, const FaceField<Dim, char>& known, int reach) {
  const Layout<Dim>& layout = domain.layout;
  FaceField<Dim, char> interior(layout);
  for (int a = 0; a < Dim; ++a) {
    for_each_marked(layout, layout.padded(), known[a].data(), [&](Site f) { interior.at(a, f) = 1; });
    for (int axis = 0; axis < Dim; ++axis) {
      const FieldValues<char> old = interior[a];
      const bool periodic = layout.geometry().periodic[axis];
      const int last = layout.geometry().cells[axis] - (axis == a ? 0 : 1);
      Box<Dim> box = layout.faces(a);
      for (int later = axis + 1; later < Dim; ++later) box.lower[later] -= reach, box.upper[later] += reach;
      for_each_row(layout, box.cut(layout.padded()), [&](Site f, const IVec<Dim>& i, int length) {
        char* to = interior[a].data() + f;
        if (std::memchr(to, 1, std::size_t(length)) == nullptr) return;
        if (axis == 0) return require_along_row(old.data() + f, i[0], length, reach, periodic, last, to);
        const int from = periodic ? -reach : std::max(-reach, -i[axis]),
                  until = periodic ? reach : std::min(reach, last - i[axis]);
        for (int k = from; k <= until; ++k) require_all(old.data() + f + k * layout.stride(axis), length, to);
      });
    }
  }
  return interior;
}

// The valid faces and those beside solids. Halo filled. Collective.
template <int Dim>
FaceField<Dim, char> faces_known(const Domain<Dim>& domain, const FaceField<Dim, char>& valid,
                                 const FaceField<Dim, char>& beside) {
  FaceField<Dim, char> known = valid;
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), beside[a].data(), [&](Site f) { known.at(a, f) = 1; });
  domain.halo.fill_ghosts(known);
  return known;
}

// Faces of a flow that transport may read, and the order that holds there. `g`: geometry of the solve.
template <int Dim>
struct Surroundings {
  CellField<Dim, char> reached;   // sites that the step may touch
  FaceField<Dim, char> beside;    // solids, where the flow is continued into them
  FaceField<Dim, char> interior;  // a step's path reads known faces: of second order
  FaceField<Dim, char> deep;      // the stencils at its end read known faces, too
  FaceField<Dim, char> liquid;    // deep, and no solid within reach; only of viscous liquid
  FaceField<Dim, char> whole;     // of fourth order; only with plan.full

  Surroundings(const Setup<Dim>& s, const StepGeometry<Dim>& g, const FaceField<Dim, char>& valid,
               const FaceField<Dim, char>& near, const ViscousPlan& plan)
      : reached(reached_sites(s.domain, near)) {
    const int path = int(std::ceil(s.scene->time.cfl)), path_and_stencil = path + 2;
    const bool solids = !s.solids.bodies.empty();
    beside = solids ? faces_beside_solids(s.domain, s.solids, g, near) : FaceField<Dim, char>(s.domain.layout);
    const FaceField<Dim, char> known = solids ? faces_known(s.domain, valid, beside) : valid;
    interior = faces_within(s.domain, known, path);
    deep = faces_within(s.domain, known, path_and_stencil);
    if (s.fluids.is_viscous()) liquid = solids ? faces_within(s.domain, valid, path_and_stencil) : deep;
    if (plan.full) whole = whole_faces(s.domain.layout, s.domain.sides, uncut_faces(s.domain, g, valid));
  }
};

// w = u(t + dt/2), m/s: in the interior extrapolated from up to three time levels if may_extrapolate(), elsewhere the
// present u. Levels that did not know a face count where it lies beside a solid: they were continued into it.
template <int Dim>
FaceField<Dim> path_velocity(const Domain<Dim>& domain, const TimeSpec& time, const State<Dim>& state,
                             const Flow<Dim>& flow, const Surroundings<Dim>& around, const ViscousPlan& plan,
                             double dt) {
  FaceField<Dim> w = flow.now->u;
  if (plan.full) continue_beyond_walls(domain.layout, domain.sides, state.time, FaceValues::means, w);
  continue_beyond_inflows(domain.layout, domain.sides, state.time, w);
  let_air_follow(domain.layout, domain.sides, state.time, flow.now->valid, w);
  if (!flow.before || time.scheme == TimeScheme::first_order) return w;
  if (dt > 2 * state.dt_now) return w;  // the weights grow with dt/dt_now and amplify noise
  if (!may_extrapolate(domain, state, dt)) return w;
  const bool three = flow.earlier != nullptr && state.dt_now <= 2 * state.dt_before;
  const auto c = half_step_weights(dt, state.dt_now, three ? state.dt_before : 0);
  const TimeLevel<Dim>&l0 = *flow.now, &l1 = *flow.before, &l2 = three ? *flow.earlier : *flow.before;
  for (int a = 0; a < Dim; ++a)
    for_each_marked(domain.layout, domain.layout.faces(a), around.interior[a].data(), [&](Site f) {
      const bool knew = (l1.valid.at(a, f) && l2.valid.at(a, f)) || around.beside.at(a, f);
      if (knew && around.reached[f]) w.at(a, f) = c[0] * l0.u.at(a, f) + c[1] * l1.u.at(a, f) + c[2] * l2.u.at(a, f);
    });
  fill_velocity_ghosts(domain.layout, domain.halo, domain.sides, w);
  if (plan.full) continue_beyond_walls(domain.layout, domain.sides, state.time + dt / 2, FaceValues::means, w);
  continue_beyond_inflows(domain.layout, domain.sides, state.time + dt / 2, w);
  let_air_follow(domain.layout, domain.sides, state.time + dt / 2, flow.now->valid, w);
  return w;
}

// Field to transport: `inner` where all data it needs are known, `outer` elsewhere.
template <int Dim>
struct Carried {
  FaceField<Dim> inner;
  const FaceField<Dim>& outer;
};

// inner = outer + dt/2 A + memory, on the sites that transport reaches.
template <int Dim>
void set_inner(const Layout<Dim>& layout, const CellField<Dim, char>& reached, const FaceField<Dim>& acceleration,
               const FaceField<Dim>& memory, double dt, Carried<Dim>& carried) {
  for (int a = 0; a < Dim; ++a)
    for_each_marked(layout, layout.padded(), reached.data(), [&](Site f) {
      carried.inner.at(a, f) = carried.outer.at(a, f) + 0.5 * dt * acceleration.at(a, f) + memory.at(a, f);
    });
}

// u continued beyond the sides and through walls, m/s. Refers to u itself where nothing is continued, else to `own`.
template <int Dim>
const FaceField<Dim>& continued_flow(const Domain<Dim>& domain, const NoSlipSolids<Dim>& solids,
                                     const FaceField<Dim>& u, double t, bool beyond_walls, FaceField<Dim>& own) {
  if (!beyond_walls && !domain.sides.any_inflow() && !domain.sides.any_waves() && !solids.any()) return u;
  own = u;
  continue_through_walls(domain, solids, own);
  if (beyond_walls) continue_beyond_walls(domain.layout, domain.sides, t, FaceValues::means, own);
  continue_beyond_inflows(domain.layout, domain.sides, t, own);
  return own;
}

// u(x) <- u(x) + d + excess_of_mean(d), d = I[v](x_d) - v(x), with v the point values of the velocity. The discrete
// flow consists of face means, while paths begin and end at points.
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

// Forces of no-slip walls that are known before the solve.
template <int Dim>
void act_at_walls(const Setup<Dim>& s, const State<Dim>& state, const StepGeometry<Dim>& g, double way, double dt,
                  Transported<Dim>& r) {
  const NoSlipSolids<Dim> solids(s, state, g, way);
  const WallForces forces = add_wall_viscosity(s, solids, state, g, r.through_walls, dt, r.u);
  r.through_walls = {};
  r.viscous_power += forces.power;
  r.wall_loads.stress = forces.loads;
  add_slit_loads(s, solids, state, g, dt, r.wall_loads);
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
Brought<Dim> transport_surface(const Setup<Dim>& s, const State<Dim>& state, FaceField<Dim> path, double t, double dt,
                               const PlacedSources<Dim>& sources, const CellField<Dim, char>& closed,
                               CellField<Dim>& phi) {
  const Domain<Dim>& d = s.domain;
  check_forces_of_step(d, s.fluids, sources.sources(), t, t + dt);
  CellField<Dim> joined = phi;
  if (d.sides.any_inflow()) join_inflow(d.layout, d.halo, d.ranks, d.sides, t, joined);
  LevelSetTransport how;
  if (s.fluids.has_prescribed_flow()) how.trace = Trace::third_order;  // transport is the only error there
  how.one_sided_at_medial_axis = s.features.has(Feature::one_sided_at_medial_axis);  // docs/decisions/0023-kinks.md
  if (!s.fluids.has_prescribed_flow()) {
    continue_beyond_inflows(d.layout, d.sides, t, path);
    let_air_follow(d.layout, d.sides, t, state.now->valid, path);
  }
  const double span = s.perturbation.surface_advection * dt;
  advect_level_set(d.layout, path, span, d.band(), joined, phi, how);
  if (!s.fluids.has_prescribed_flow()) carry_slow_near_closed(d, closed, state, std::move(path), span, joined, phi);
  fill_level_set_ghosts(d.layout, d.halo, phi);
  return add_sources(d, s.solids, sources.openings(), state, t, t + dt, phi);
}

template <int Dim>
void make_distance(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const TimeSpec& time,
                   const CellField<Dim, char>& closed, CellField<Dim>& phi) {
  const int moved = int(std::ceil(time.cfl)) + 1;
  redistance_beside_solids(domain, solids, closed,
                           {domain.band() / domain.layout.h(), 6 + 2 * moved, moved, closest_point_band(fluids)}, 1,
                           phi);
}

template <int Dim>
FaceField<Dim, char> faces_near_liquid(const Domain<Dim>& domain, const CellField<Dim>& phi) {
  FaceField<Dim, char> near(domain.layout);
  for (int a = 0; a < Dim; ++a) {
    const double* low = phi.data() - domain.layout.stride(a);
    const auto may_matter = [&](Site f) { return any_negative(phi.data() + f) || any_negative(low + f); };
    for_each_possible(domain.layout, domain.layout.faces(a), may_matter, [&](Site f) {
      if (phi[f] < 0 || phi[f - domain.layout.stride(a)] < 0) near.at(a, f) = 1;
    });
  }
  return near;
}

template <int Dim>
FaceField<Dim, char> faces_near_gas(const Domain<Dim>& domain, const CellField<Dim>& phi) {
  FaceField<Dim, char> near(domain.layout);
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (phi[f] >= 0 || phi[f - domain.layout.stride(a)] >= 0) near.at(a, f) = 1;
    });
  return near;
}

template <int Dim>
Transported<Dim> transport_flow(const Setup<Dim>& s, const State<Dim>& state, const Flow<Dim>& flow,
                                const FaceField<Dim, char>& near, double dt, const ViscousPlan& plan,
                                const StepGeometry<Dim>& geometry) {
  const Surroundings<Dim> around(s, geometry, flow.now->valid, near, plan);
  const FaceField<Dim, char>& interior = around.interior;
  const NoSlipSolids<Dim> walls(s, state, geometry, plan.way);
  FaceField<Dim> path = path_velocity(s.domain, s.scene->time, state, flow, around, plan, dt);
  continue_through_walls(s.domain, walls, path);
  const FaceField<Dim> memory =
      viscous_memory(s.domain, s.fluids, s.scene->time.scheme, state, flow, around.liquid, dt, plan);
  Transported<Dim> r;
  r.acceleration = carried_acceleration(s.domain, s.fluids, s.scene->time, s.perturbation, state, flow, around.reached,
                                        around.deep, dt);
  const FaceField<Dim>& acc = r.acceleration;
  FaceField<Dim> own;
  Carried<Dim> carried{FaceField<Dim>(s.domain.layout),
                       continued_flow(s.domain, walls, flow.now->u, state.time, plan.full, own)};
  set_inner(s.domain.layout, around.reached, acc, memory, dt, carried);
  // The viscous operator also couples faces beside those near liquid.
  FaceField<Dim>& u = r.u;
  u = s.fluids.is_viscous() ? flow.now->u : FaceField<Dim>(s.domain.layout);
  if (plan.full)
    advect_means(s.domain, s.perturbation, state, carried, path, near, interior, around.whole, dt, u);
  else
    advect_faces(s.domain.layout, path, s.perturbation.velocity_advection * dt, near, interior, carried.inner,
                 carried.outer, u);
  const FacePaths<Dim> paths{path, near, s.perturbation.velocity_advection * dt};
  limit_at_surfaces(s.domain, *flow.now, paths, interior, u);
  if (plan.full) r.viscous_power = add_missing_viscosity(s.domain, s.fluids, state, around.whole, carried.outer, dt, u);
  const Vec3 g = s.perturbation.gravity * s.fluids.gravity.of_step(state.time + dt, dt);
  for (int a = 0; a < Dim; ++a)
    for_each_marked(s.domain.layout, s.domain.layout.faces(a),
                    s.fluids.is_viscous() ? around.reached.data() : near[a].data(),
                    [&](Site f) { u.at(a, f) += dt * (g[a] - (interior.at(a, f) ? 0.5 * acc.at(a, f) : 0)); });
  stop_in_slits(s.domain, walls, state, geometry, *flow.now, g, dt, u);
  let_liquid_in(s.domain, s.fluids, s.scene->time, s.perturbation, *flow.now, paths, state.time, memory, u);
  if (walls.any()) r.through_walls = std::move(own);
  return r;
}

template <int Dim>
Transported<Dim> transport_velocity(const Setup<Dim>& s, const State<Dim>& state, const CellField<Dim>& phi, double dt,
                                    const ViscousPlan& plan, const StepGeometry<Dim>& geometry,
                                    const PlacedSources<Dim>& sources, const CellField<Dim>* brought) {
  Transported<Dim> r = state.exterior->transported_velocity(s, state, phi, dt, plan, geometry);
  const auto mass = [&](int a, Site f) {
    const bool was_within = state.phi[f - s.domain.layout.stride(a)] < 0 && state.phi[f] < 0;
    return was_within && geometry.faces.is_unknown(a, f)
               ? mass_at_face(s.domain.layout, s.fluids, phi, geometry.psi, brought, a, f)
               : 0;
  };
  r.by_sources = set_source_velocity<Dim>(s.domain, sources.sources(), state.time, state.time + dt, mass, r.u);
  act_at_walls(s, state, geometry, plan.way, dt, r);
  fill_velocity_ghosts(s.domain.layout, s.domain.halo, s.domain.sides, r.u);
  return r;
}

template <int Dim>
double control_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, double expected, double limit,
                      CellField<Dim>& phi) {
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  const VolumeAndArea own = local_volume_and_area(domain.layout, phi, psi);
  std::array<double, 2> sums{own.volume, own.area};
  domain.ranks.global_sum(sums);
  const auto [volume, area] = sums;
  if (area <= 0) return 0;
  const double by = std::clamp((expected - volume) / area, -limit, limit);
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) {
    if (std::abs(phi[c]) < domain.band()) phi[c] -= by;
  });
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  return liquid_volume(domain, phi, psi) - volume;
}

#define SEICHE_INSTANTIATE(D)                                                                                        \
  template double liquid_volume<D>(const Domain<D>&, const CellField<D>&, const NodeField<D>&);                      \
  template Brought<D> transport_surface<D>(const Setup<D>&, const State<D>&, FaceField<D>, double, double,           \
                                           const PlacedSources<D>&, const CellField<D, char>&, CellField<D>&);       \
  template void make_distance<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const TimeSpec&,                 \
                                 const CellField<D, char>&, CellField<D>&);                                          \
  template FaceField<D, char> faces_near_liquid<D>(const Domain<D>&, const CellField<D>&);                           \
  template FaceField<D, char> faces_near_gas<D>(const Domain<D>&, const CellField<D>&);                              \
  template Transported<D> transport_flow<D>(const Setup<D>&, const State<D>&, const Flow<D>&,                        \
                                            const FaceField<D, char>&, double, const ViscousPlan&,                   \
                                            const StepGeometry<D>&);                                                 \
  template Transported<D> transport_velocity<D>(const Setup<D>&, const State<D>&, const CellField<D>&, double,       \
                                                const ViscousPlan&, const StepGeometry<D>&, const PlacedSources<D>&, \
                                                const CellField<D>*);                                                \
  template double control_volume<D>(const Domain<D>&, const NodeField<D>&, double, double, CellField<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
