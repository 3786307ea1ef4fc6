// One time step, as the algorithm reads: move bodies, measure geometry, transport, solve, restore.
#include <fmt/format.h>

#include "base/error.h"
#include "coupling/solids/sealed_liquid.h"
#include "coupling/solids/solid_coupling.h"
#include "coupling/solve/coupled_solve.h"
#include "coupling/solve/rheology_iteration.h"
#include "coupling/state/fluids.h"
#include "coupling/state/state.h"
#include "coupling/step/leapfrog.h"
#include "coupling/step/step.h"
#include "coupling/step/step_size.h"
#include "coupling/tension/surface_tension.h"
#include "coupling/thin/gap_flow.h"
#include "coupling/thin/liquid_beside.h"
#include "coupling/thin/thin_solids.h"
#include "coupling/transport/air_volume.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/level_in_solids.h"
#include "coupling/transport/prescribed_flow.h"
#include "coupling/transport/restore.h"
#include "coupling/transport/transport.h"
#include "coupling/transport/two_fluids.h"
#include "coupling/transport/viscous_transport.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

constexpr double poison = std::numeric_limits<double>::quiet_NaN();

// Empty, or where the first value that is no number stands. Collective.
template <int Dim>
std::string find_non_finite(const Domain<Dim>& domain, const std::string& name, const Box<Dim>& box, const double* f) {
  std::string mine;
  for_each_index_in_order(domain.layout, box, [&](Site c, const IVec<Dim>& i) {
    if (!mine.empty() || std::isfinite(f[c])) return;
    mine = fmt::format("{} is not a number at cell ({}", name, i[0]);
    for (int a = 1; a < Dim; ++a) mine += fmt::format(", {}", i[a]);
    mine += ")";
  });
  if (!domain.ranks.any(!mine.empty())) return {};
  for (const std::string& text : domain.ranks.all_gather(mine))
    if (!text.empty()) return text;
  return {};
}

template <int Dim>
std::string find_non_finite(const Domain<Dim>& domain, const std::string& name, const FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    if (auto text = find_non_finite(domain, name + "[" + "xyz"[a] + "]", domain.layout.faces(a), u[a].data());
        !text.empty())
      return text;
  return {};
}

// Writes a NaN where a test asks for one.
template <int Dim>
void inject(const Domain<Dim>& domain, PhaseFault fault, double* f) {
  if (fault == PhaseFault::poison && !domain.layout.cells().empty())
    f[domain.layout.site(domain.layout.cells().lower)] = poison;
}

// Volume that flows in through the sides during the step, as the liquid there is counted.
template <int Dim>
double net_inflow(const Domain<Dim>& domain, const StepGeometry<Dim>& g, const CellField<Dim>& phi,
                  const FaceField<Dim>& u) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      Box<Dim> box = domain.layout.faces(a);
      if (box.empty() || !(side == 0 ? domain.layout.at_lower(a) : domain.layout.at_upper(a))) continue;
      (side == 0 ? box.upper[a] : box.lower[a]) = side == 0 ? box.lower[a] + 1 : box.upper[a] - 1;
      for_each_index_in_order(domain.layout, box, [&](Site f, const IVec<Dim>&) {
        const Site inside = side == 0 ? f : f - domain.layout.stride(a);
        const double inward = (side == 0 ? 1 : -1) * g.faces.open.at(a, f) * u.at(a, f);
        const bool fed = domain.sides.type(a, side) == SideType::inflow && inward > 0;
        const double share = std::clamp(0.5 - phi[inside] / domain.layout.h(), 0.0, 1.0);
        sum += inward * (fed ? 1 : share);
      });
    }
  return domain.ranks.global_sum(sum) * domain.layout.geometry().face_area();
}

// Empty volume that phi still counts as liquid, m^Dim.
template <int Dim>
double gap_volume(const Domain<Dim>& domain, const Fluids& fluids, const Separation<Dim>& separation) {
  if (!fluids.liquid.separates) return 0;
  const double cells =
      local_sum(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) { return separation.gap[c]; });
  return domain.ranks.global_sum(cells) * domain.layout.geometry().cell_volume();
}

// A gap of half a cell becomes air.
template <int Dim>
void open_gaps(const Domain<Dim>& domain, State<Dim>& state) {
  for_each_site(domain.layout, domain.layout.cells(), [&](Site c) {
    if (state.separation.gap[c] < 0.5) return;
    state.phi[c] = std::max(state.phi[c], (state.separation.gap[c] - 0.5) * domain.layout.h());
    state.separation.gap[c] = 0;
  });
  fill_level_set_ghosts(domain.layout, domain.halo, state.phi);
}

template <int Dim>
std::string verify(const Domain<Dim>& domain, const CellField<Dim>& phi, const FaceField<Dim>& u_star) {
  std::string text = find_non_finite(domain, "phi", domain.layout.cells(), phi.data());
  return text.empty() ? find_non_finite(domain, "u", u_star) : text;
}

// A step between its phases. Each phase tells the hook and the timers, and leaves what the next ones need.
template <int Dim>
struct StepInProgress {
  const Setup<Dim>& s;
  const State<Dim>& before;
  double dt;
  Phases& phases;
  bool by_halves;
  double lead;  // s, from the start of the step to where the solve finds surface and solids
  Attempt<Dim> out;
  FaceField<Dim> u_star;
  ViscousPlan plan;
  ViscosityField<Dim> shared;
  std::optional<CellField<Dim>> guess;  // of the pressure, by an earlier solve of the step
  std::optional<SurfaceTension<Dim>> tension;
  CoupledSolution<Dim> solution;

  StepInProgress(const Setup<Dim>& setup, const State<Dim>& state, double step, Phases& p)
      : s(setup),
        before(state),
        dt(step),
        phases(p),
        by_halves(is_leapfrog_step(setup.solids, setup.sources, setup.features, state, step)),
        lead(by_halves ? step / 2 : step) {
    State<Dim>& next = out.state = state;
    next.time = state.time + dt;
    next.step = state.step + 1;
    next.earlier = state.before;
    next.before = state.now;
    next.gas.earlier = state.gas.before;
    next.gas.before = state.gas.now;
    next.dt_before = state.dt_now;
    next.dt_now = dt;
  }

  void move_bodies() {
    const std::vector<Eigen::VectorXd> velocities = each_velocity_over(s.solids, before, dt);
    for (std::size_t k = 0; k < velocities.size(); ++k)
      out.state.solids[k].advance({s, before, dt, lead, velocities[k]});
  }

  void measure_geometry() {
    const PhaseFault fault = phases.enter("geometry");
    const auto timed = phases.timers.measure("geometry");
    out.geometry =
        s.solids.geometry.measure(by_halves ? place_halfway(out.state, dt) : place_bodies(out.state), out.state.time);
    check_geometry_of_step(s.domain, s.solids, s.scene.domain, out.geometry, before.time, out.state.time);
    inject(s.domain, fault, out.geometry.faces.closed_flux[0].data());
  }

  void transport_surface() {
    const PhaseFault fault = phases.enter("transport");
    const auto timed = phases.timers.measure("surface");
    const FaceField<Dim> u = s.fluids.has_prescribed_flow()
                                 ? prescribed_flow(s.domain, s.fluids, before.phi, before.time + 0.5 * dt)
                                 : flow_at_surface(s.domain, s.fluids, before);
    CellField<Dim>& phi = out.state.phi;
    const CellField<Dim, char> closed = cells_to_continue(s.domain, s.solids, out.geometry, phi);
    // Redistancing at the end of the transport takes in ceil(cfl) + 1 cells: above two a half before is too much.
    if (!by_halves && may_leapfrog(s.features) && s.scene.time.cfl > 2) make_distance(s, closed, phi);
    out.state.expected_volume += seiche::transport_surface(s, before, u, before.time, lead, phi);
    make_distance(s, closed, phi);
    inject(s.domain, fault, out.state.phi.data());
  }

  void keep_volumes() {
    const auto timed = phases.timers.measure("surface");
    out.state.expected_volume += lead * net_inflow(s.domain, out.geometry, before.phi, before.now->u);
    keep_sides_of_walls(s.domain, out.geometry, out.state.phi);
    keep_sealed_full(s, before, out.state, out.geometry, out.state.phi);
    if (has_thin_elastic(s.solids)) keep_sides_apart(s.domain, s.solids, before, out.geometry, out.state.phi);
    const double uncounted = gap_volume(s.domain, s.fluids, before.separation) +
                             volume_beyond(s.domain, s.solids, out.geometry, out.state.phi);
    const double expected = out.state.expected_volume + uncounted, limit = volume_shift();
    if (s.fluids.keeps_air())
      control_liquid_and_air(expected, limit);
    else
      out.state.corrected_volume += control_volume(s.domain, out.geometry.psi, expected, limit, out.state.phi);
    keep_sides_apart(s.domain, s.solids, before, out.geometry, out.state.phi);
    if (s.fluids.keeps_air())
      out.state.air =
          follow_air(s.domain, out.state.air, before.now->u, 0, out.geometry, out.state.phi, out.state.lost_air);
    if (s.fluids.has_surface_tension()) tension = surface_tension(s, out.geometry, before.phi, out.state.phi, lead, dt);
  }

  void control_liquid_and_air(double expected, double limit) {
    State<Dim>& next = out.state;
    next.air = follow_air(s.domain, before.air, before.now->u, dt, out.geometry, next.phi, next.lost_air);
    next.corrected_volume += control_volumes(s.domain, out.geometry, expected, limit, next.air, next.phi);
  }

  // In place of the solve, where the scene gives the flow.
  void prescribe_velocity() {
    out.failure = find_non_finite(s.domain, "phi", s.domain.layout.cells(), out.state.phi.data());
    out.state.now = prescribed_level(s.domain, s.fluids, out.state.phi, out.state.time);
    out.divergence = largest_divergence(s.domain, out.state.phi, out.state.now->u);
  }

  bool transport_velocity() {
    const auto timed = phases.timers.measure("velocity");
    plan = plan_viscosity(s, before, out.state.phi, dt);
    u_star = seiche::transport_velocity(s, before, out.state.phi, dt, plan, out.geometry);
    set_gap_velocity(s.domain, out.geometry.faces, before.gap_flow, s.fluids.gravity.of_step(out.state.time, dt), dt,
                     u_star);
    fill_velocity_ghosts(s.domain.layout, s.domain.halo, s.domain.sides, u_star);
    out.failure = verify(s.domain, out.state.phi, u_star);
    return out.failure.empty();
  }

  ProjectionInput<Dim> input() const {
    const Separation<Dim>* separation = s.fluids.liquid.separates ? &out.state.separation : nullptr;
    const AirRegions<Dim>* air = s.fluids.keeps_air() ? &out.state.air : nullptr;
    const FaceField<Dim>* jump = tension ? &tension->jump : nullptr;
    return {s.domain.layout,
            s.domain.halo,
            s.domain.ranks,
            out.state.phi,
            out.geometry.faces,
            s.fluids.density(),
            dt,
            separation,
            s.perturbation.gas_density * s.fluids.gas_density(),
            jump,
            air};
  }

  bool solve(const ViscosityField<Dim>* viscosity) {
    const PhaseFault fault = phases.enter("solve");
    const auto timed = phases.timers.measure("solve");
    const int earlier = out.solve.iterations;
    const FaceField<Dim> slope = of_both(s.domain, before, &TimeLevel<Dim>::q),
                         flow = of_both(s.domain, before, &TimeLevel<Dim>::u);
    solution = solve_coupled(CoupledInput<Dim>{s, input(), out.geometry, out.state, guess ? *guess : out.state.pressure,
                                               slope, flow, u_star, out.state.horizon, viscosity, fault});
    out.solve = solution.report;
    out.solve.iterations += earlier;
    out.newton_iterations = solution.newton_iterations;
    out.contacts = solution.contacts;
    out.separation_error = solution.separation_error;
    out.failure = solution.failure;
    out.state.pressure = solution.pressure;
    return out.failure.empty();
  }

  void restore() {
    const PhaseFault fault = phases.enter("restore");
    const auto timed = phases.timers.measure("restore");
    equalise_air_pressure(input(), solution.rows, solution.u_star, out.state.pressure);
    Restored<Dim> restored =
        restore_velocity(s, input(), solution.rows, out.state.pressure, solution.u_star, out.geometry);
    set_viscous_acceleration(restored.level);
    auto level = std::make_shared<TimeLevel<Dim>>(std::move(restored.level));
    if (s.fluids.has_gas()) {
      set_viscous_acceleration(restored.gas);
      out.state.gas.now = std::make_shared<TimeLevel<Dim>>(std::move(restored.gas));
    }
    out.state.gap_flow = std::move(restored.gap_flow);
    out.divergence = restored.divergence;
    if (s.fluids.liquid.separates) {
      advance_gaps(input(), solution.rows, out.state.pressure, solution.u_star, out.state.separation);
      open_gaps(s.domain, out.state);
    }
    inject(s.domain, fault, level->u[0].data());
    out.failure = find_non_finite(s.domain, "u", level->u);
    out.state.now = level;
    out.state.viscous_loads = solution.viscous_loads;
    out.dissipation = solution.dissipation / plan.implicit;
  }

  // What viscosity added to u*.
  void set_viscous_acceleration(TimeLevel<Dim>& level) const {
    for (int a = 0; a < Dim && s.fluids.is_viscous(); ++a)
      for_each_site(s.domain.layout, s.domain.layout.faces(a), [&](Site f) {
        if (level.valid.at(a, f) == face_solved)
          level.n.at(a, f) = (solution.u_star.at(a, f) - u_star.at(a, f)) / (plan.implicit * dt);
      });
  }

  // The viscosity that the step's implicit share leaves.
  const ViscosityField<Dim>* implicit_part(const ViscosityField<Dim>& viscosity) {
    if (plan.implicit == 1) return &viscosity;
    shared = viscosity;
    for_each_site(s.domain.layout, s.domain.layout.padded(), [&](Site c) { shared.value[c] *= plan.implicit; });
    for (int p = 0; shared.edge && p < EdgeField<Dim>::count; ++p)
      for (double& mu : (*shared.edge)[p]) mu *= plan.implicit;
    return &shared;
  }

  // Where viscosity depends on the flow, until both agree.
  void solve_and_restore() {
    if (!s.fluids.is_viscous()) {
      if (solve(nullptr)) restore();
      return;
    }
    const State<Dim> moved = out.state;
    const StepGeometry<Dim> measured = out.geometry;
    RheologyIteration<Dim> rheology(s, out.state.phi, *before.now, out.state.time);
    do {
      start_again(moved, measured);
      if (!solve(implicit_part(rheology.viscosity()))) return;
      restore();
      if (!out.failure.empty()) return;
    } while (rheology.differs_from(*out.state.now));
    out.rheology_iterations = rheology.count();
    out.state.viscous_rate =
        rheology.viscosity().largest / (s.fluids.density() * s.domain.layout.h() * s.domain.layout.h());
  }

  // The solve leads the elastic bodies to the end of the coming step, which is planned before it is known how fast they
  // and the flow will be. Where these turn out too fast a shorter one is solved for: cut short, it would go straight
  // towards where the longer one leads, and stretch what turns. Once: light bodies that crumple get to where forces
  // balance in any step, the faster the shorter it is, and are not caught up with (a sheet with E = 100 Pa blew up).
  // A solve for the longer one that fails, as of bodies in contact that find no state, is taken for half of it, twice
  // at most.
  void solve_for_a_step_to_come() {
    constexpr int most_plans = 2, most_failures = 2;
    out.state.horizon = choose_horizon(s, out.state, dt);
    if (!s.solids.plans_steps() || s.scene.time.fixed_step) return solve_and_restore();
    const State<Dim> moved = out.state;
    const StepGeometry<Dim> measured = out.geometry;
    for (int plans = 1, failures = 0;;) {
      solve_and_restore();
      double shorter = out.state.horizon / 2;
      if (!out.failure.empty()) {
        if (++failures > most_failures) return;
      } else {
        if (++plans > most_plans || can_go_as_planned(s, out.state)) return;
        shorter = choose_horizon(s, out.state, dt);
      }
      start_again(moved, measured);
      out.failure.clear();
      out.state.horizon = shorter;
    }
  }

  // The other half of the way, with the velocities of the end of the step; where these are too fast for it, with those
  // of its start.
  void go_the_other_half() {
    const auto timed = phases.timers.measure("surface");
    State<Dim>& next = out.state;
    const bool on = can_go_on(s.domain, s.solids, s.scene.time, next, dt);
    const State<Dim>& leading = on ? next : before;
    const FaceField<Dim> u = flow_at_surface(s.domain, s.fluids, leading);
    next.expected_volume += lead * net_inflow(s.domain, out.geometry, next.phi, leading.now->u);
    next.expected_volume += seiche::transport_surface(s, next, u, before.time + lead, lead, next.phi);
    for (std::size_t k = 0; k < next.solids.size(); ++k) next.solids[k].go_on(leading.solids[k], lead);
    if (any_moves(s.solids)) out.geometry = placed_at_end(s.solids, next, std::move(out.geometry));
    const double expected = next.expected_volume + gap_volume(s.domain, s.fluids, next.separation);
    next.corrected_volume += control_volume(s.domain, out.geometry.psi, expected, volume_shift(), next.phi);
  }

  // The most that the volume control moves the surface by, m.
  double volume_shift() const { return 0.05 * s.domain.layout.h(); }

  // The pressure found is the first guess of the next solve. That of a solve that failed is not: it may be anything.
  // The state keeps that of the last step, which elastic bodies are held by, whatever was tried in between.
  void start_again(const State<Dim>& moved, const StepGeometry<Dim>& measured) {
    if (out.failure.empty()) guess = std::move(out.state.pressure);
    out.state = moved;
    out.geometry = measured;
  }
};

}  // namespace

template <int Dim>
Attempt<Dim> attempt_step(const Setup<Dim>& s, const State<Dim>& state, double dt, Phases& phases) {
  StepInProgress<Dim> step(s, state, dt, phases);
  if (s.fluids.has_prescribed_flow())
    step.out.failure = fault_of_prescribed(s.domain, s.fluids, s.scene.time, state, dt);
  if (!step.out.failure.empty()) return std::move(step.out);
  step.move_bodies();
  step.measure_geometry();
  step.transport_surface();
  step.keep_volumes();
  if (s.fluids.has_prescribed_flow())
    step.prescribe_velocity();
  else if (step.transport_velocity())
    step.solve_for_a_step_to_come();
  if (step.by_halves && step.out.failure.empty()) step.go_the_other_half();
  return std::move(step.out);
}

template Attempt<2> attempt_step<2>(const Setup<2>&, const State<2>&, double, Phases&);
template Attempt<3> attempt_step<3>(const Setup<3>&, const State<3>&, double, Phases&);

}  // namespace seiche
