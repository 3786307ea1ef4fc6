#include "coupling/step/solve_phases.h"

#include <algorithm>
#include <utility>

#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/drops/deposit.h"
#include "coupling/solve/coupled_solve.h"
#include "coupling/solve/rheology_iteration.h"
#include "coupling/state/dry.h"
#include "coupling/step/checks.h"
#include "coupling/step/side_flow.h"
#include "coupling/step/step_size.h"
#include "coupling/thin/gap_flow.h"
#include "coupling/transport/feeds.h"
#include "coupling/transport/forces.h"
#include "coupling/transport/level_in_solids.h"
#include "coupling/transport/prescribed_flow.h"
#include "coupling/transport/restore.h"
#include "coupling/transport/transport.h"
#include "fluid/viscosity/load_sums.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// All that the solves of a step read and do not change.
template <int Dim>
struct SolveTask {
  const Setup<Dim>& s;
  const State<Dim>& before;
  const std::optional<SurfaceTension<Dim>>& tension;
  const Predicted<Dim>& predicted;
  const StepTimes& times;
  Phases& phases;
};

// Several solves of a step from the same place: a later one begins with the pressure of an earlier one that succeeded.
template <int Dim>
struct Solves {
  std::optional<CellField<Dim>> guess = {};       // Pa; empty: the pressure of the step before
  int iterations = 0;                             // of all solves
  std::optional<FlowAtWalls<Dim>> at_walls = {};  // empty: that at the start of the step
  Eigen::VectorXd solids = {};                    // velocities of the bodies' unknowns over this horizon; empty: none
  CellField<Dim, char> separated = {};            // cells separated from walls; empty: none known

  // The pressure of a solve that failed may be anything.
  void go_on_from(Attempt<Dim> attempt) {
    iterations = attempt.solve.iterations;
    if (!attempt.failure.empty()) return;
    guess = std::move(attempt.state.pressure);
    separated = std::move(attempt.state.separation.separated);
  }

  // Bodies that do not meet within one horizon may within another.
  void go_on_with_horizon(Attempt<Dim> attempt) {
    go_on_from(std::move(attempt));
    solids.resize(0);
  }
};

// Time in which the excess of full cells flows out, s: ten of the longest of the last steps. Few of them are short.
template <int Dim>
double time_of_excess(const State<Dim>& before, double dt) {
  return 10 * std::max({dt, before.dt_now, before.dt_before});
}

template <int Dim>
ProjectionInput<Dim> projection_input(const SolveTask<Dim>& task, const State<Dim>& state,
                                      const StepGeometry<Dim>& geometry) {
  const Setup<Dim>& s = task.s;
  ProjectionInput<Dim> in{s.domain.layout, s.domain.halo,      s.domain.ranks, state.phi,
                          geometry.faces,  s.fluids.density(), task.times.dt};
  if (s.fluids.liquid.separates) in.separation = &state.separation;
  if (task.tension) in.surface_jump = &task.tension->jump;
  if (!state.liquid.empty()) {
    in.share = &state.liquid;
    in.room = state.room();
    in.excess_time = time_of_excess(task.before, task.times.dt);
  }
  if (!task.predicted.filling.empty()) in.filling = &task.predicted.filling.inflow;
  state.exterior->set_rows(s.fluids, s.perturbation, in);
  return in;
}

// A gap of half a cell at a wall becomes air.
template <int Dim>
void open_gaps(const Domain<Dim>& domain, State<Dim>& state) {
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (state.separation.gap[c] < 0.5) return;
    state.phi[c] = std::max(state.phi[c], (state.separation.gap[c] - 0.5) * domain.layout.h());
    state.separation.gap[c] = 0;
  });
  fill_level_set_ghosts(domain.layout, domain.halo, state.phi);
}

// N, the acceleration by viscosity: the solve's u* less the one predicted, over the implicit share of dt.
template <int Dim>
void set_viscous_acceleration(const SolveTask<Dim>& task, const FaceField<Dim>& solved_u_star, TimeLevel<Dim>& level) {
  const double span = task.predicted.viscosity.implicit * task.times.dt;
  const Layout<Dim>& layout = task.s.domain.layout;
  for (int a = 0; a < Dim && task.s.fluids.is_viscous(); ++a)
    for_each_site(layout, layout.faces(a), [&](Site f) {
      if (is_solved(level.valid.at(a, f)))
        level.n.at(a, f) = (solved_u_star.at(a, f) - task.predicted.u_star.at(a, f)) / span;
    });
}

// The viscosity that the step's implicit share leaves.
template <int Dim>
ViscosityField<Dim> implicit_part(const Layout<Dim>& layout, ViscosityField<Dim> viscosity, double share) {
  if (share == 1) return viscosity;
  for_each_site(layout, layout.padded(), [&](Site c) { viscosity.value[c] *= share; });
  for (int p = 0; viscosity.edge && p < EdgeField<Dim>::count; ++p)
    for (double& mu : (*viscosity.edge)[p]) mu *= share;
  return viscosity;
}

// Sets pressure, solids and counts of `out`.
template <int Dim>
CoupledSolution<Dim> solve(const SolveTask<Dim>& task, const ViscosityField<Dim>* viscosity, const Solves<Dim>& earlier,
                           const EndOfStep<Dim>* end, Attempt<Dim>& out) {
  const Setup<Dim>& s = task.s;
  const PhaseFault fault = task.phases.enter("solve");
  const auto timed = task.phases.timers.measure("solve");
  const auto flow = task.before.exterior->joined_level(s.domain, s.fluids, task.before);
  const ProjectionInput<Dim> liquid = projection_input(task, out.state, out.geometry);
  const CellField<Dim>& guess = earlier.guess ? *earlier.guess : out.state.pressure;
  CoupledSolution<Dim> solution = solve_coupled(CoupledInput<Dim>{
      s, liquid, out.geometry, out.state, guess, flow->q, flow->u, task.predicted.u_star, task.predicted.convected,
      end ? &end->flux : nullptr, out.state.horizon, viscosity, fault, earlier.at_walls ? &*earlier.at_walls : nullptr,
      &earlier.solids, &earlier.separated, &task.predicted.wall_loads});
  out.state.convected_loads = task.predicted.convected.loads;
  out.powers.contact = solution.contact_power;
  out.solve = solution.report;
  out.solve.iterations += earlier.iterations;
  out.newton_iterations = solution.newton_iterations;
  out.contacts = solution.contacts;
  out.joint_turns = solution.joint_turns;
  out.friction_settled = solution.friction_settled;
  out.separation_error = solution.separation_error;
  out.failure = solution.failure;
  out.state.impacts = solution.impacts;
  if (!is_dry(s)) out.state.pressure = solution.pressure;
  return solution;
}

// Power of the jumps of the pressure at the surface, with the mean of two velocities, W. Collective.
template <int Dim>
double tension_power(const ProjectionInput<Dim>& in, const PressureRows<Dim>& rows, const FaceField<Dim>& from,
                     const FaceField<Dim>& to) {
  if (!in.surface_jump) return 0;
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    sum -= local_sum(in.layout, in.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      if (!in.faces.is_unknown(a, f) || !rows.touch_pressure(f - in.layout.stride(a), f)) return 0.0;
      return 0.5 * jump_over(in, a, f) * in.faces.open.at(a, f) * (from.at(a, f) + to.at(a, f));
    });
  return in.ranks.global_sum(sum) * in.layout.geometry().face_area();
}

// Work of impulses, with the mean of two velocities, J (2D: J/m). Collective.
template <int Dim>
double work_of(const std::vector<FaceImpulse>& impulses, const FaceField<Dim>& from, const FaceField<Dim>& to,
               const Communicator& ranks) {
  double sum = 0;
  for (const FaceImpulse& i : impulses) sum += 0.5 * i.impulse * (from.at(i.axis, i.face) + to.at(i.axis, i.face));
  return ranks.global_sum(sum);
}

// Powers of the solve, with its velocity.
template <int Dim>
void set_powers(const SolveTask<Dim>& task, const CoupledSolution<Dim>& solution, const ProjectionInput<Dim>& liquid,
                const TimeLevel<Dim>& level, Attempt<Dim>& out) {
  const Setup<Dim>& s = task.s;
  const double implicit = task.predicted.viscosity.implicit;
  out.powers.viscous = {solution.viscous.dissipation / implicit, solution.viscous.sides / implicit,
                        solution.viscous.before / implicit};
  out.powers.viscous_transport = task.predicted.viscous_power;
  out.powers.tension = tension_power(liquid, solution.rows, task.before.now->u, level.u);
  if (!s.feeds.empty())
    out.powers.feeds = power_of_feeds(s.domain, s.fluids.density(), task.predicted.fed, out.state.pressure, level.u);
  if (!s.sources.empty())
    out.powers.work_of_sources = work_of(task.predicted.by_sources, task.before.now->u, level.u, s.domain.ranks);
}

// Sets the velocity of `out` from the pressure. `end`: where the solids will be that it fits; null: where they are.
template <int Dim>
void restore(const SolveTask<Dim>& task, const CoupledSolution<Dim>& solution, const EndOfStep<Dim>* end,
             Attempt<Dim>& out) {
  const Setup<Dim>& s = task.s;
  const PhaseFault fault = task.phases.enter("restore");
  const auto timed = task.phases.timers.measure("restore");
  const ProjectionInput<Dim> liquid = projection_input(task, out.state, out.geometry);
  equalise_air_pressure(liquid, solution.rows, solution.u_star, out.state.pressure);
  const CellField<Dim>& phi = out.state.phi;
  auto level =
      std::make_shared<TimeLevel<Dim>>(solved_level(s.domain, s.fluids, s.solids, s.perturbation, liquid, solution.rows,
                                                    out.state.pressure, solution.u_star, out.geometry));
  out.divergence = max_divergence(liquid, solution.rows, level->u);
  set_viscous_acceleration(task, solution.u_star, *level);
  out.state.exterior->take(s.domain, s.fluids, s.solids, out.geometry, phi, *level);
  out.state.gap_flow = measure_gap_flow(s.domain, out.geometry.faces, level->u);
  if (end) place_at(end->geometry, out.geometry);
  continue_level(s.domain, s.fluids, s.solids, out.geometry, faces_near_liquid(s.domain, phi), *level);
  if (s.fluids.liquid.separates) {
    advance_gaps(liquid, solution.rows, out.state.pressure, solution.u_star, out.state.separation);
    open_gaps(s.domain, out.state);
  }
  inject(s.domain, fault, level->u[0].data());
  out.failure = find_non_finite(s.domain, "u", level->u);
  out.state.now = level;
  out.state.viscous_loads = solution.viscous_loads;
  for (const auto* loads : {&task.predicted.wall_loads.stress, &task.predicted.wall_loads.carrying})
    add_loads(*loads, out.state.viscous_loads);
  set_powers(task, solution, liquid, *level, out);
}

// One solve from where surface and solids stand, with a given viscosity (null: none).
template <int Dim>
Attempt<Dim> solve_once(const SolveTask<Dim>& task, Moved<Dim> moved, const ViscosityField<Dim>* viscosity,
                        Solves<Dim>& solves) {
  Attempt<Dim> out;
  out.state = std::move(moved.state);
  out.geometry = std::move(moved.geometry);
  CoupledSolution<Dim> solution = solve(task, viscosity, solves, moved.end.get(), out);
  if (out.failure.empty()) {
    if (!is_dry(task.s)) restore(task, solution, moved.end.get(), out);
    solves.solids = std::move(solution.solids);
  }
  return out;
}

// Viscosity that depends on the flow is solved for until both agree (Picard), and so is the flow that fluxes at walls
// are taken from.
template <int Dim>
Attempt<Dim> solve_viscous(const SolveTask<Dim>& task, const Moved<Dim>& moved, Solves<Dim>& solves) {
  const Layout<Dim>& layout = task.s.domain.layout;
  RheologyIteration<Dim> rheology(task.s, moved.state, *task.before.now);
  FlowAtWallsIteration<Dim> walls(task.s, task.before, moved.state.solids, moved.geometry);
  for (;;) {
    const ViscosityField<Dim> implicit = implicit_part(layout, rheology.viscosity(), task.predicted.viscosity.implicit);
    Attempt<Dim> out = solve_once(task, moved, &implicit, solves);
    if (!out.failure.empty()) return out;
    auto at_walls = walls.due_after(out.state);
    if (!rheology.differs_from(*out.state.now, out.friction_settled) && !at_walls) {
      out.rheology_iterations = rheology.count();
      out.rheology_change = rheology.change_left();
      out.state.viscous_rate = rheology.viscosity().largest / (task.s.fluids.density() * layout.h() * layout.h());
      return out;
    }
    if (at_walls) solves.at_walls = std::move(at_walls);
    solves.go_on_from(std::move(out));
  }
}

template <int Dim>
Attempt<Dim> solve_for_horizon(const SolveTask<Dim>& task, Moved<Dim> moved, Solves<Dim>& solves) {
  if (task.s.fluids.is_viscous() && !is_dry(task.s)) return solve_viscous(task, moved, solves);
  return solve_once<Dim>(task, std::move(moved), nullptr, solves);
}

// Joints are closed where the next solve stands: in the middle of the planned step if this one goes by halves.
template <int Dim>
void set_plan(const Solids<Dim>& solids, double plan, State<Dim>& state) {
  state.planned = plan;
  const bool halves = solids.leads_ahead() && state.since_solve > 0;
  state.horizon = halves ? state.since_solve + plan / 2 : plan;
}

// Time from the place of the solids that the present flow fits to that of the solve, s; 0 for forces that are those of
// the middle of the step.
template <int Dim>
double since_flow_fitted(const Fluids& fluids, const Solids<Dim>& solids, const State<Dim>& before,
                         const StepTimes& times) {
  if (!fits_end_of_step(fluids, solids)) return before.since_solve + times.lead;
  return times.leapfrog ? 0 : times.dt;
}

}  // namespace

template <int Dim>
Predicted<Dim> predict_velocity(const Setup<Dim>& s, const State<Dim>& before, const Moved<Dim>& moved,
                                const StepTimes& times, Phases& phases) {
  const auto timed = phases.timers.measure("velocity");
  const CellField<Dim>& phi = moved.state.phi;
  Predicted<Dim> p;
  p.viscosity = plan_viscosity(s.domain, s.fluids, s.scene->time, s.features, before, phi, times.dt);
  const double way = p.viscosity.way = since_flow_fitted(s.fluids, s.solids, before, times);
  const PlacedSources<Dim> sources(s, moved.state, times.start + times.lead);
  Transported<Dim> transported = transport_velocity(s, before, phi, times.dt, p.viscosity, moved.geometry, sources,
                                                    moved.brought ? &*moved.brought : nullptr);
  const Vec3 gravity = s.fluids.gravity.of_step(moved.state.time, times.dt);
  act_on_liquid(s, phi, moved.state.time, times.dt, transported.u);
  if (way > 0)
    p.convected =
        convected_pressure(s.domain, s.fluids, s.solids, moved.state.solids, moved.geometry, phi, transported, way);
  p.u_star = std::move(transported.u);
  p.viscous_power = transported.viscous_power;
  p.wall_loads = std::move(transported.wall_loads);
  p.by_sources = std::move(transported.by_sources);
  p.fed = moved.fed;
  set_gap_velocity(s.domain, moved.geometry.faces, before.gap_flow, gravity, times.dt, p.u_star);
  if (moved.closed)
    keep_inertia_near_closed(s.domain, moved.geometry.faces, *moved.closed, before, phi, gravity, times.dt, p.u_star);
  if (s.volume_meets_void())
    give_momentum(s.domain, moved.geometry.faces, phi, moved.state.liquid, moved.landed, p.u_star);
  if (s.domain.sides.any_passes()) brake_entering(s.domain, moved.geometry.faces, times.dt, p.u_star);
  if (s.domain.sides.any_passes() || !s.solids.bodies.empty())  // else as transported, ghosts filled
    fill_velocity_ghosts(s.domain.layout, s.domain.halo, s.domain.sides, p.u_star);
  p.failure = find_non_finite(s.domain, "phi", s.domain.layout.cells(), phi.data());
  if (p.failure.empty()) p.failure = find_non_finite(s.domain, "u", p.u_star);
  return p;
}

// The solve leads elastic solids to the end of the coming step, which is planned before the speeds of solids and flow
// are known. Where these turn out too fast, a shorter step is solved for: cut short instead, the solids would head
// straight for where the longer one leads, and rotating ones stretch. Once only: light bodies that crumple get to where
// forces balance in any step, faster the shorter it is (a sheet with E = 100 Pa blew up). A solve that fails, as of
// bodies in contact that find no state, is tried for half the horizon, twice at most.
template <int Dim>
Attempt<Dim> solve_and_plan(const Setup<Dim>& s, const State<Dim>& before, Moved<Dim> moved,
                            const Predicted<Dim>& predicted, const StepTimes& times, Phases& phases) {
  constexpr int most_plans = 2, most_failures = 2;
  const std::optional<SurfaceTension<Dim>> tension = std::exchange(moved.tension, std::nullopt);
  const SolveTask<Dim> task{s, before, tension, predicted, times, phases};
  Solves<Dim> solves;
  if (times.looks_ahead()) {
    set_plan(s.solids, times.dt, moved.state);
    Attempt<Dim> out = solve_for_horizon(task, std::move(moved), solves);
    if (out.failure.empty()) out.failure = fault_of_start(s.domain.layout.h(), s.solids, out.state);
    return out;
  }
  set_plan(s.solids, choose_horizon(s, moved.state, times.dt), moved.state);
  if (!s.solids.plans_steps() || s.scene->time.fixed_step) return solve_for_horizon(task, std::move(moved), solves);
  for (int plans = 1, failures = 0;;) {
    Attempt<Dim> out = solve_for_horizon(task, moved, solves);
    if (!out.failure.empty()) {
      if (++failures > most_failures) return out;
      set_plan(s.solids, moved.state.planned / 2, moved.state);
    } else {
      if (++plans > most_plans || can_go_as_planned(s, out.state)) return out;
      set_plan(s.solids, choose_horizon(s, out.state, times.dt), moved.state);
    }
    solves.go_on_with_horizon(std::move(out));
  }
}

template <int Dim>
Attempt<Dim> solve_within_room(const Setup<Dim>& s, const State<Dim>& before, Moved<Dim> moved,
                               Predicted<Dim> predicted, const StepTimes& times, Phases& phases) {
  constexpr int most_solves = 3;  // the fold that closes goes on by a cell a solve; what is left is little
  const Vec3 gravity = s.perturbation.gravity * s.fluids.gravity.of_step(moved.state.time, times.dt);
  const Drops<Dim>& drops = moved.state.drops;
  std::optional<CellField<Dim>> with_drops;
  if (s.domain.ranks.any(!drops.list.empty()))
    with_drops = share_with_drops(s.domain.layout, s.domain.halo, drops, moved.state.liquid);
  const CellField<Dim>& share = with_drops ? *with_drops : moved.state.liquid;
  const FillingStep<Dim> step{share, before.now->u, gravity, times.dt, moved.state.room(), &*moved.state.exterior};
  for (int solves = 1, iterations = 0;; ++solves) {
    Attempt<Dim> out = solve_and_plan(s, before, moved, predicted, times, phases);
    out.solve.iterations += iterations;
    if (!out.failure.empty()) return out;
    const auto timed = phases.timers.measure("surface");
    if (solves == most_solves || !add_filling_cells(s.domain, out.geometry.faces, step, out.state.now->u,
                                                    moved.state.phi, predicted.u_star, predicted.filling)) {
      if (!predicted.filling.empty()) out.state.phi = std::move(predicted.filling.phi);
      return out;
    }
    iterations = out.solve.iterations;
    moved.state.pressure = std::move(out.state.pressure);
  }
}

template <int Dim>
Attempt<Dim> prescribe_velocity(const Domain<Dim>& domain, const Fluids& fluids, Moved<Dim> moved) {
  Attempt<Dim> out;
  out.state = std::move(moved.state);
  out.geometry = std::move(moved.geometry);
  out.failure = find_non_finite(domain, "phi", domain.layout.cells(), out.state.phi.data());
  out.state.now = prescribed_level(domain, fluids, out.state, out.state.time);
  out.divergence = largest_divergence(domain, out.state.phi, out.state.now->u);
  return out;
}

#define SEICHE_INSTANTIATE(D)                                                                                          \
  template Predicted<D> predict_velocity<D>(const Setup<D>&, const State<D>&, const Moved<D>&, const StepTimes&,       \
                                            Phases&);                                                                  \
  template Attempt<D> solve_within_room<D>(const Setup<D>&, const State<D>&, Moved<D>, Predicted<D>, const StepTimes&, \
                                           Phases&);                                                                   \
  template Attempt<D> solve_and_plan<D>(const Setup<D>&, const State<D>&, Moved<D>, const Predicted<D>&,               \
                                        const StepTimes&, Phases&);                                                    \
  template Attempt<D> prescribe_velocity<D>(const Domain<D>&, const Fluids&, Moved<D>);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
