#include "coupling/report/energy_account.h"

#include <algorithm>

#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/transport/forces.h"
#include "fluid/boundary/domain.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Calls visit(axis, face, inside, inward) for the faces of the domain's sides: the cell inside, and +1 on low sides, -1
// on high ones.
template <int Dim, class Visit>
void for_each_side_face(const Domain<Dim>& domain, const Visit& visit) {
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1})
      for_each_index_in_order(domain.layout, faces_of_side(domain.layout, a, side), [&](Site f, const IVec<Dim>&) {
        visit(a, f, side == 0 ? f : f - domain.layout.stride(a), side == 0 ? 1.0 : -1.0);
      });
}

// |u|^2/2 in a cell at a side, with the velocity of the face along its axis, m^2/s^2.
template <int Dim>
double half_square(const Domain<Dim>& domain, const FaceField<Dim>& u, int axis, Site face, Site inside) {
  double square = std::pow(u.at(axis, face), 2);
  for (int a = 0; a < Dim; ++a)
    if (a != axis) square += std::pow(0.5 * (u.at(a, inside) + u.at(a, inside + domain.layout.stride(a))), 2);
  return 0.5 * square;
}

// Kinetic energy over the density that one fluid brings through the sides with the velocity u, less that which it takes
// out, m^(Dim+2)/s^3. share(axis, inside, inward, flow): its share of what flows. Local.
template <int Dim, class Share>
double kinetic_inflow_of(const Domain<Dim>& domain, const FaceGeometry<Dim>& faces, const FaceField<Dim>& u,
                         const Share& share) {
  double sum = 0;
  for_each_side_face(domain, [&](int a, Site f, Site inside, double inward) {
    const FaceKind kind = faces.kind_at(a, f);
    if (kind != FaceKind::prescribed && kind != FaceKind::outflow) return;
    const double flow = inward * faces.open.at(a, f) * u.at(a, f);
    if (flow != 0) sum += flow * share(a, inside, inward, flow) * half_square(domain, u, a, f, inside);
  });
  return sum * domain.layout.geometry().face_area();
}

// Kinetic energy that enters through the sides with the velocities of a state, less that which leaves, W. Each fluid
// flows with its own velocity. An inflow side feeds liquid; elsewhere the cell inside tells the shares. Collective.
template <int Dim>
double kinetic_inflow(const Domain<Dim>& domain, const Fluids& fluids, const FaceGeometry<Dim>& faces,
                      const State<Dim>& state) {
  const auto liquid = [&](int a, Site inside, double inward, double flow) {
    const bool fed = flow > 0 && domain.sides.type(a, inward > 0 ? 0 : 1) == SideType::inflow;
    return fed ? 1.0 : std::clamp(0.5 - state.phi[inside] / domain.layout.h(), 0.0, 1.0);
  };
  const auto gas = [&](int a, Site inside, double inward, double flow) { return 1 - liquid(a, inside, inward, flow); };
  double sum = fluids.density() * kinetic_inflow_of(domain, faces, state.now->u, liquid);
  if (state.exterior->flows())
    sum += fluids.gas_density() * kinetic_inflow_of(domain, faces, state.exterior->flow.now->u, gas);
  return domain.ranks.global_sum(sum);
}

// F v + T omega, W, with the torque about `position`.
double power(const SolidLoad& load, const Vec3& position, const Twist& twist) {
  return load.force.dot(twist.at(position)) + load.torque.dot(twist.angular);
}

// Weight of the viscous stress at the start of a step in its mean over the step: 1/2 up to
// mu dt/(rho h^2) = 1/2. From 1 on, stiff stress is that of the end alone.
template <int Dim>
double weight_of_start(const State<Dim>& state, double dt) {
  return std::clamp(1 - dt * state.viscous_rate, 0.0, 0.5);
}

// Heat in a step, J (2D: J/m). S V u: power of the stress S on the motion u, with - and + for the start and the end.
//   gentle: dt/2 (u-'V u- + u+'V u+), to second order;   stiff: dt/2 (u- + u+)'V u+, what the solve takes from the flow
// The first is z times the energy there was after a solve that left 1/(1 + z) of a motion that decays at the rate z/dt.
template <int Dim>
double heat_of_step(const State<Dim>& before, const State<Dim>& state, const SolvePowers& powers, double dt) {
  const double w = weight_of_start(state, dt);
  return dt * (w * before.viscous_power.dissipation + (0.5 - w) * powers.viscous.before +
               0.5 * powers.viscous.dissipation - powers.viscous_transport);
}

// Load of the fluids on solid k in the step: that of the solve, on faces of the grid, with the viscous one a mean over
// the step.
template <int Dim>
SolidLoad mean_load(const State<Dim>& before, const State<Dim>& state, const SolidState& solid, std::size_t k) {
  SolidLoad load{solid.force - solid.unseen_force, solid.torque - solid.unseen_torque};
  if (before.viscous_loads.empty() || state.viscous_loads.empty()) return load;
  const double w = weight_of_start(state, state.time - before.time);
  load.force += w * (before.viscous_loads[k].force - state.viscous_loads[k].force);
  load.torque += w * (before.viscous_loads[k].torque - state.viscous_loads[k].torque);
  return load;
}

// Power of prescribed solids against the loads of the fluids, W. Their velocities are means over a step; the loads
// belong to its start, where two of them meet.
template <int Dim>
double power_of_prescribed(const State<Dim>& before, const State<Dim>& state, const StepGeometry<Dim>& geometry,
                           const std::vector<SolidState>& solids) {
  const std::vector<Placement> earlier = place_bodies(before);
  double sum = 0;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const Participant<Dim>& solid = state.solids[k];
    const SolidLoad load = mean_load(before, state, solids[k], k);
    for (const Placement& placed : {earlier[k], geometry.placed[k]})
      sum -= 0.5 * power(load, solids[k].position, solid.prescribed_part(placed).twist);
  }
  return sum;
}

// Work of pins and of forces that the scene applies, J. Loads of the first solve may be the blows of a sudden start,
// which are over: the way after it counts those of the second alone.
template <int Dim>
double driven_work(const Solids<Dim>& solids, const State<Dim>& before, const State<Dim>& state, double dt) {
  const double span = state.horizon > 0 ? state.horizon : dt;
  const Participants<Dim>& earlier = before.step > 1 ? before.solids : state.solids;
  double sum = 0;
  for (std::size_t k = 0; k < state.solids.size(); ++k)
    sum += state.solids[k].driven_work(earlier[k], state.time, span);
  for (const auto& interaction : solids.interactions) sum += interaction->driven_work(state, dt);
  return sum;
}

// Power of pressure, shear and what enters, on the fluids through the sides, W: means over the step.
template <int Dim>
double power_of_sides(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& before,
                      const Attempt<Dim>& a) {
  const double w = weight_of_start(a.state, a.state.time - before.time);
  const double viscous = w * before.viscous_power.sides + (1 - w) * a.powers.viscous.sides;
  if (!domain.sides.any_passes()) return viscous;
  const auto from = before.exterior->joined_level(domain, fluids, before);
  const auto to = a.state.exterior->joined_level(domain, fluids, a.state);
  const double entering = kinetic_inflow(domain, fluids, a.geometry.faces, before) +
                          kinetic_inflow(domain, fluids, a.geometry.faces, a.state);
  return pressure_power_of_sides(domain, fluids, from->u, to->u, a) + viscous + 0.5 * entering;
}

}  // namespace

template <int Dim>
double pressure_power_of_sides(const Domain<Dim>& domain, const Fluids& fluids, const FaceField<Dim>& from,
                               const FaceField<Dim>& to, const Attempt<Dim>& attempt) {
  const FaceGeometry<Dim>& faces = attempt.geometry.faces;
  const bool everywhere = attempt.state.exterior->flows();
  double sum = 0;
  for_each_side_face(domain, [&](int a, Site f, Site inside, double inward) {
    const double flow = 0.5 * inward * faces.open.at(a, f) * (from.at(a, f) + to.at(a, f));
    const FaceKind kind = faces.kind_at(a, f);
    if (kind == FaceKind::prescribed) sum += flow * attempt.state.pressure[inside];
    const bool wet = attempt.state.phi[inside] < 0;
    if (kind != FaceKind::outflow || !(wet || everywhere)) return;
    const double density = wet ? fluids.density() : fluids.gas_density();
    sum += flow * (faces.side_pressure.at(a, f) - 0.5 * density * faces.entering.at(a, f) * inward * to.at(a, f));
  });
  return domain.ranks.global_sum(sum) * domain.layout.geometry().face_area();
}

// Pressure and tension of the solve times the mean of the velocities before and after it; the trapezoidal rule for the
// rest. The first step is not counted, since a sudden start has no work of its own.
template <int Dim>
Work work_after(const Setup<Dim>& s, const State<Dim>& before, const StepStats& start,
                const std::vector<SolidState>& solids, const Attempt<Dim>& a) {
  const Domain<Dim>& domain = s.domain;
  const Fluids& fluids = s.fluids;
  if (before.step == 0) return {};
  const double dt = a.state.time - before.time;
  const SolvePowers& powers = a.powers;
  Work w = a.state.work;
  w.gravity += 0.5 * dt * fluids.gravity.of_step(a.state.time, dt).dot(start.momentum + a.stats.momentum);
  w.tension += dt * powers.tension;
  w.sides += dt * (power_of_sides(domain, fluids, before, a) + powers.feeds) + powers.work_of_sources;
  w.solids += dt * (power_of_prescribed(before, a.state, a.geometry, solids) + powers.contact) +
              driven_work(s.solids, before, a.state, dt) +
              (s.forces.empty() && s.sponges.empty() ? 0 : work_of_forces(s, before, a));
  w.lost_viscous += heat_of_step(before, a.state, powers, dt);
  const Work& old = before.work;
  const double done = w.gravity - old.gravity + w.tension - old.tension + w.sides - old.sides + w.solids - old.solids;
  const double gained = a.stats.kinetic_energy + a.stats.elastic_energy - start.kinetic_energy - start.elastic_energy;
  w.lost_numerical += done - gained - (w.lost_viscous - old.lost_viscous);
  return w;
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template double pressure_power_of_sides<D>(const Domain<D>&, const Fluids&, const FaceField<D>&,                \
                                             const FaceField<D>&, const Attempt<D>&);                             \
  template Work work_after<D>(const Setup<D>&, const State<D>&, const StepStats&, const std::vector<SolidState>&, \
                              const Attempt<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
