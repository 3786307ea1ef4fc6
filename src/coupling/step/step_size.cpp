// Length of the next step.
#include <fmt/format.h>

#include "base/error.h"
#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/state/dry.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/step/step_size.h"
#include "coupling/tension/surface_tension.h"
#include "coupling/transport/given_motion.h"
#include "coupling/transport/placed_sources.h"
#include "coupling/transport/prescribed_flow.h"
#include "coupling/transport/viscous_transport.h"
#include "fluid/boundary/domain.h"
#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {

namespace {

// Largest component of the drops' velocities, m/s. Drops need no short steps themselves, but the liquid that they come
// from does (docs/decisions/0066-drops.md). Collective.
template <int Dim>
double fastest_drop(const Domain<Dim>& domain, const Drops<Dim>& drops) {
  double fastest = 0;
  for (const Drop<Dim>& d : drops.list) fastest = std::max(fastest, d.velocity.template lpNorm<Eigen::Infinity>());
  return domain.ranks.global_max(fastest);
}

// The flow crosses at most cfl cells: (v + g dt) dt = cfl h. The shortest gravity waves, omega^2 = pi g/h, have omega
// dt <= 1.5, since the leapfrog of surface and velocity is stable below 2. Squares of the rates of gravity and tension
// add. Fields of forces count as gravity.
template <int Dim>
double limit_of_present_flow(const Setup<Dim>& s, const State<Dim>& state, double until) {
  const Domain<Dim>& domain = s.domain;
  const Fluids& fluids = s.fluids;
  if (fluids.has_prescribed_flow())
    return limit_of_prescribed(domain, fluids, s.scene->time, state, until - state.time);
  const bool dry = is_dry(s);
  const double v = dry ? 0 : std::max(fastest_component(domain, state), fastest_drop(domain, state.drops)),
               reach = s.scene->time.cfl * domain.layout.h(),
               g = fluids.gravity.largest(state.time, until) +
                   largest_field(s.forces, domain.layout.geometry(), state.time, until);
  const double capillary = capillary_step(domain, fluids);
  if (g == 0) return std::min(capillary, v > 0 ? reach / v : std::numeric_limits<double>::infinity());
  const double flow = 2 * reach / (v + std::sqrt(v * v + 4 * g * reach));
  if (!dry && !state.exterior->flows() && !has_surface(domain, state.phi))
    return std::min(flow, capillary);  // nothing to wave
  const double waves = 1.5 * std::sqrt(domain.layout.h() / (3.14159265358979323846 * g));
  return std::min(flow, waves / std::sqrt(1 + waves * waves / (capillary * capillary)));
}

// Velocities that sides and sources give are limited likewise, as the flow takes them on within the step.
template <int Dim>
double limit_of_flow(const Setup<Dim>& s, const State<Dim>& state, double until) {
  const double limit = limit_of_present_flow(s, state, until);
  if (s.fluids.has_prescribed_flow()) return limit;
  const double span = std::min(limit, until - state.time);
  const PlacedSources<Dim> sources(s, state, state.time);
  const double given = limit_of_given_flow(s.domain, s.scene->time, sources.sources(), state.time, span);
  return given < span ? given : limit;
}

constexpr double relative_rounding = 1e-9;  // relative, for motions that use the whole reach

std::string pinned_step(const TimeSpec& time, double t, double dt) {
  return fmt::format("time.fixed_step = {:g} s: the step of {:.6g} s from time {:.6g} s carries", *time.fixed_step, dt,
                     t);
}

// Places and velocities of the solids over the coming dt.
template <int Dim>
std::vector<Placement> motion_ahead(const State<Dim>& state, double dt) {
  std::vector<Placement> placed;
  for (std::size_t k = 0; k < state.solids.size(); ++k) {
    placed.push_back(state.solids[k].place(state.time, state.time + dt, state.time + dt));
    state.solids[k].set_velocity(placed.back());
  }
  return placed;
}

// Largest displacement of solids in dt, m. Prescribed ones may be back at their start by then, so parts of dt count,
// too.
template <int Dim>
double largest_way(const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  double largest = 0;
  for (const double part : {1.0, 0.29, 0.5})
    largest = std::max(largest, solids.geometry.largest_displacement(motion_ahead(state, part * dt), part * dt));
  return largest;
}

// Moving solids go at most one cell a step.
template <int Dim>
double limit_of_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  if (solids.contact && state.step > 0) dt = std::min(dt, step_growth * state.dt_now);
  for (int n = 0; n < 60 && largest_way(solids, state, dt) > domain.layout.h(); ++n) dt /= 2;
  return dt;
}

// Forces f that the scene applies set a solid of mass m off with a = sqrt(f'M^-1 f/m), the root mean square of its
// nodes' accelerations and at least that of its centre. The first step has a dt^2/2 <= h; later ones grow from it. A
// light solid that would cross the domain in one step costs hundreds of Newton iterations.
template <int Dim>
double limit_of_first_push(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  double limit = dt;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    for (const double t : {state.time, state.time + dt}) {
      const double square = state.solids[k].pull(t);
      if (square > 0)
        limit = std::min(limit, std::sqrt(2 * domain.layout.h() / std::sqrt(square / solids.bodies[k].mass().mass)));
    }
  return limit;
}

// A first step by backward Euler leads elastic solids too far by g dt^2/2 for good: h/16 here. Those that touch liquid
// stand still in it (look_ahead.h).
template <int Dim>
double limit_of_first_fall(const Domain<Dim>& domain, const Fluids& fluids, double t, double dt) {
  const double g = fluids.gravity.largest(t, t + dt);
  return g > 0 ? std::min(dt, std::sqrt(domain.layout.h() / (8 * g))) : dt;
}

// Pressures p of outflow sides set fluids of density rho off from rest with at most p/(rho h): a dt^2/2 <= h in the
// first step. Later ones see the flow. Collective.
template <int Dim>
double limit_of_side_pressures(const Domain<Dim>& domain, const Fluids& fluids, double t, double dt) {
  const Layout<Dim>& layout = domain.layout;
  double largest = 0;
  for (int a = 0; a < Dim; ++a)
    for (const int side : {0, 1}) {
      if (!domain.sides.is_outflow(a, side)) continue;
      for_each_index_in_order(layout, faces_of_side(layout, a, side), [&](Site, const IVec<Dim>& i) {
        const Vec<Dim> x = layout.position(i, face_offset<Dim>(a));
        for (const double when : {t, t + dt})
          largest = std::max(largest, std::abs(domain.sides.pressure(a, side, x, when)));
      });
    }
  largest = domain.ranks.global_max(largest);
  const double density = fluids.has_gas() ? std::min(fluids.density(), fluids.gas_density()) : fluids.density();
  return largest > 0 ? std::min(dt, layout.h() * std::sqrt(2 * density / largest)) : dt;
}

// Halves the remaining time if a step of dt would leave less than another one.
double land(double dt, double remaining) {
  if (dt >= remaining * (1 - 1e-9)) return remaining;
  return 2 * dt > remaining ? remaining / 2 : dt;
}

// Longest step of at most dt, a whole number of which fills the remaining time.
double share_evenly(double dt, double remaining) {
  return remaining / std::max(1.0, std::ceil(remaining / dt - 1e-9));
}

// Time from t to the next frame, or to the end.
double until_frame(const TimeSpec& spec, double t) {
  const double frame = std::floor(t * spec.frame_rate * (1 + 1e-12) + 1e-9) + 1;
  const double next = frame / spec.frame_rate;
  return t < spec.end * (1 - 1e-12) ? std::min(next, spec.end) - t : next - t;
}

// Share of the straight path over dt on which no element inverts, for a step other than the one solved for.
template <int Dim>
double share_without_damage(const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  double share = 1;
  const std::vector<Eigen::VectorXd> v = each_velocity_over(solids, state, dt);
  for (std::size_t k = 0; k < v.size(); ++k) share = std::min(share, state.solids[k].possible_share(dt * v[k]));
  return share;
}

std::string too_short(double dt, double remaining, double h, const std::string& held) {
  return fmt::format("steps of {:.3g} s are too short: {:.3g} s remain to the next frame (limit {} steps); {}", dt,
                     remaining, most_steps_a_frame,
                     held.empty() ? fmt::format("the flow or a solid is too fast for cells of {:.3g} m", h)
                                  : "the gap between these solids is too small for them to move: " + held);
}

}  // namespace

// Each check follows straight paths to the solids' places at the end of the step. A shorter step ends elsewhere, so it
// is checked again.
template <int Dim>
double hold_back(const Solids<Dim>& solids, const State<Dim>& state, double dt) {
  if (solids.leads_ahead() && dt == state.planned) return dt;  // the solve excluded collisions and inversions
  constexpr int most_looks = 40;
  constexpr double margin = 0.9;  // the next check then finds the share of gaps that it wants left
  for (int n = 0; n < most_looks; ++n) {
    const double share = std::min(safe_share(solids, state, dt), share_without_damage(solids, state, dt));
    if (share >= 1) return dt;
    dt *= margin * share;
  }
  return 0;
}

// The halo holds paths of ceil(cfl) cells.
template <int Dim>
std::string fault_of_pinned_flow(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                                 const State<Dim>& state, double dt) {
  const double h = domain.layout.h(), cfl = time.cfl, most = std::ceil(cfl);
  const double speed = fluids.has_prescribed_flow() ? fastest_prescribed(domain, fluids, state, state.time + 0.5 * dt)
                                                    : fastest_component(domain, state);
  const double crossed = speed * dt / h;
  if (crossed <= most * (1 + relative_rounding)) return {};
  return fmt::format("{} the flow {:.6g} cells of {:g} m; at most {:g} are possible at cfl = {:g}; lower fixed_step{}",
                     pinned_step(time, state.time, dt), crossed, h, most, cfl, cfl < 8 ? " or raise cfl" : "");
}

// A solid that moves further than a cell skips faces.
template <int Dim>
std::string fault_of_pinned_solids(const Domain<Dim>& domain, const Solids<Dim>& solids, const TimeSpec& time,
                                   const std::vector<Placement>& placed, double t, double dt) {
  const double h = domain.layout.h(), crossed = solids.geometry.largest_displacement(placed, dt) / h;
  if (crossed <= 1 + relative_rounding) return {};
  return fmt::format(
      "{} a solid {:.6g} cells of {:g} m; at most 1 is possible; lower fixed_step or slow the solid down",
      pinned_step(time, t, dt), crossed, h);
}

// Plans 0.9 of the step that the flow allows now: if the flow speeds up, the step can still be taken as planned. Steps
// divide the time to the frame evenly. The solve moves solids over the coming step and liquid over this one. Lengths
// that varied with the frames fed energy to a flap as slow as the waves (e-fold in 3 s).
//
// Plans a whole step where a frame is all but there, or lies just after the end. Solved for over 1e-7 s, a body whose
// step was 0.04 s gained 1e5 times its energy. The step then falls short of the plan. The liquid hardly changes its
// velocity in a tiny step: it would bend a body by as much as it flows in a plan much longer than that.
template <int Dim>
double choose_horizon(const Setup<Dim>& s, const State<Dim>& next, double dt) {
  const TimeSpec& spec = s.scene->time;
  if (!s.solids.leads_ahead()) return spec.fixed_step ? std::max(dt, *spec.fixed_step) : step_growth * dt;
  constexpr double margin = 0.9, least = 0.1;
  const double remaining = until_frame(spec, next.time);
  if (spec.fixed_step) {
    const double plan = std::min(*spec.fixed_step, dt / least);
    return remaining < least * plan ? plan : std::min(plan, remaining);
  }
  double plan = std::min(step_growth * dt, margin * limit_of_flow(s, next, next.time + remaining));
  if (spec.max_step) plan = std::min(plan, *spec.max_step);
  plan = limit_of_solids(s.domain, s.solids, next, plan);
  return remaining < least * plan ? plan : share_evenly(plan, remaining);
}

template <int Dim>
bool can_go_as_planned(const Setup<Dim>& s, const State<Dim>& state) {
  const double until = state.time + until_frame(s.scene->time, state.time);
  const double dt = std::min(state.planned, limit_of_flow(s, state, until));
  return limit_of_solids(s.domain, s.solids, state, dt) >= state.planned * (1 - 1e-9);
}

template <int Dim>
std::string fault_of_start(double h, const Solids<Dim>& solids, const State<Dim>& found) {
  const double way = largest_way(solids, found, found.horizon);
  if (way <= h * (1 + relative_rounding)) return {};
  return fmt::format("a solid would move by {:.3g} cells", way / h);
}

template <int Dim>
double choose_step(const Setup<Dim>& s, const State<Dim>& state, double until) {
  const TimeSpec& spec = s.scene->time;
  const double remaining = until - state.time;
  if (!(remaining > 0))
    throw Error(ExitCode::bug, fmt::format("a step from {} s to {} s has no length", state.time, until));
  const bool planned = s.solids.leads_ahead() && state.step > 0 && !spec.fixed_step;
  double dt = spec.fixed_step ? *spec.fixed_step : limit_of_flow(s, state, until);
  if (spec.max_step) dt = std::min(dt, *spec.max_step);
  if (state.step == 0 && !spec.fixed_step) {
    dt = limit_of_given_velocity(state, std::min(dt, remaining));
    dt = limit_of_first_push(s.domain, s.solids, state, dt);
    if (s.solids.plans_steps()) dt = limit_of_first_fall(s.domain, s.fluids, state.time, dt);
    if (s.domain.sides.any_passes()) dt = limit_of_side_pressures(s.domain, s.fluids, state.time, dt);
  }
  if (planned && state.planned <= remaining * (1 + 1e-9) && can_go_as_planned(s, state))
    dt = state.planned;
  else if (!spec.fixed_step)
    dt = limit_of_solids(s.domain, s.solids, state, std::min(dt, remaining));
  if (s.solids.leads_ahead() && state.step > 0 && dt >= state.planned * (1 - 1e-9)) dt = state.planned;
  if (dt >= remaining * (1 - 1e-9)) dt = remaining;
  if (spec.fixed_step) {
    std::string fault = is_dry(s) ? "" : fault_of_pinned_flow(s.domain, s.fluids, s.scene->time, state, dt);
    if (fault.empty())
      fault = fault_of_pinned_solids(s.domain, s.solids, s.scene->time, motion_ahead(state, dt), state.time, dt);
    if (!fault.empty()) throw Error(ExitCode::cannot_continue, fault);
  }
  const bool as_planned = s.solids.leads_ahead() && dt == state.planned;
  if (!as_planned && !spec.fixed_step) dt = land(dt, remaining);
  const double free = hold_back(s.solids, state, dt);
  if (!(free * double(most_steps_a_frame) > remaining))
    throw Error(ExitCode::cannot_continue,
                too_short(free, remaining, s.domain.layout.h(),
                          free < dt ? nearest_solids(s.domain, s.solids, s.scene->domain, state)
                                    : solids_at_periodic_sides(s.domain, s.solids, state)));
  return free;
}

template <int Dim>
std::string note_on_long_steps(const Domain<Dim>& domain, const Fluids& fluids, const TimeSpec& time,
                               const State<Dim>& state) {
  constexpr double resolved = 2;
  const double cfl = time.cfl;
  if (cfl <= resolved || !fluids.is_viscous() || fluids.has_prescribed_flow() || has_surface(domain, state.phi))
    return {};
  return fmt::format(
      "time.cfl = {:g}: steps over more than {:g} cells do not resolve eddies of viscous liquid that fills its domain; "
      "where viscosity is low the flow loses energy, a tenth in a cavity at Re = 5000; lower cfl to {:g}",
      cfl, resolved, resolved);
}

template std::string fault_of_pinned_flow<2>(const Domain<2>&, const Fluids&, const TimeSpec&, const State<2>&, double);
template std::string fault_of_pinned_solids<2>(const Domain<2>&, const Solids<2>&, const TimeSpec&,
                                               const std::vector<Placement>&, double, double);
template std::string fault_of_pinned_flow<3>(const Domain<3>&, const Fluids&, const TimeSpec&, const State<3>&, double);
template std::string fault_of_pinned_solids<3>(const Domain<3>&, const Solids<3>&, const TimeSpec&,
                                               const std::vector<Placement>&, double, double);
template double choose_horizon<2>(const Setup<2>&, const State<2>&, double);
template double choose_horizon<3>(const Setup<3>&, const State<3>&, double);
template bool can_go_as_planned<2>(const Setup<2>&, const State<2>&);
template bool can_go_as_planned<3>(const Setup<3>&, const State<3>&);
template std::string fault_of_start<2>(double, const Solids<2>&, const State<2>&);
template std::string fault_of_start<3>(double, const Solids<3>&, const State<3>&);
template double hold_back<2>(const Solids<2>&, const State<2>&, double);
template double hold_back<3>(const Solids<3>&, const State<3>&, double);
template double choose_step<2>(const Setup<2>&, const State<2>&, double);
template double choose_step<3>(const Setup<3>&, const State<3>&, double);
template std::string note_on_long_steps<2>(const Domain<2>&, const Fluids&, const TimeSpec&, const State<2>&);
template std::string note_on_long_steps<3>(const Domain<3>&, const Fluids&, const TimeSpec&, const State<3>&);

}  // namespace seiche
