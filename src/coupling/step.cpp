// One time step, as the algorithm reads: transport, measure geometry, solve, restore.
#include <fmt/format.h>

#include "base/error.h"
#include "coupling/formula_checks.h"
#include "coupling/restore.h"
#include "coupling/transport.h"
#include "grid/loops.h"

namespace seiche {
namespace {

constexpr double poison = std::numeric_limits<double>::quiet_NaN();

// Empty, or where the first value that is no number stands. Collective.
template <int Dim>
std::string find_non_finite(const Setup<Dim>& s, const std::string& name, const Box<Dim>& box, const double* f) {
  std::string mine;
  for_each_index_in_order(s.layout, box, [&](Site c, const IVec<Dim>& i) {
    if (!mine.empty() || std::isfinite(f[c])) return;
    mine = fmt::format("{} is not a number at cell ({}", name, i[0]);
    for (int a = 1; a < Dim; ++a) mine += fmt::format(", {}", i[a]);
    mine += ")";
  });
  if (!s.ranks.any(!mine.empty())) return {};
  for (const std::string& text : s.ranks.all_gather(mine))
    if (!text.empty()) return text;
  return {};
}

template <int Dim>
std::string find_non_finite(const Setup<Dim>& s, const std::string& name, const FaceField<Dim>& u) {
  for (int a = 0; a < Dim; ++a)
    if (auto text = find_non_finite(s, name + "[" + "xyz"[a] + "]", s.layout.faces(a), u[a].data()); !text.empty())
      return text;
  return {};
}

// Writes a NaN where a test asks for one.
template <int Dim>
void inject(const Setup<Dim>& s, PhaseFault fault, double* f) {
  if (fault == PhaseFault::poison && !s.layout.cells().empty()) f[s.layout.site(s.layout.cells().lower)] = poison;
}

// Volume that flows in through the sides during the step, as the liquid there is counted.
template <int Dim>
double net_inflow(const Setup<Dim>& s, const StepGeometry<Dim>& g, const CellField<Dim>& phi, const FaceField<Dim>& u) {
  double sum = 0;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      Box<Dim> box = s.layout.faces(a);
      if (box.empty() || !(side == 0 ? s.layout.at_lower(a) : s.layout.at_upper(a))) continue;
      (side == 0 ? box.upper[a] : box.lower[a]) = side == 0 ? box.lower[a] + 1 : box.upper[a] - 1;
      for_each_index_in_order(s.layout, box, [&](Site f, const IVec<Dim>&) {
        const Site inside = side == 0 ? f : f - s.layout.stride(a);
        const double inward = (side == 0 ? 1 : -1) * g.faces.open.at(a, f) * u.at(a, f);
        const bool fed = s.sides.type(a, side) == SideType::inflow && inward > 0;
        const double share = std::clamp(0.5 - phi[inside] / s.layout.h(), 0.0, 1.0);
        // Through an outflow side liquid leaves; what flows back is air.
        const bool back = s.sides.is_outflow(a, side) && inward > 0;
        sum += back ? 0 : inward * (fed ? 1 : share);
      });
    }
  return s.ranks.global_sum(sum) * s.layout.geometry().face_area();
}

// Why a closed, full container cannot do what is asked of it; empty where it can.
template <int Dim>
std::string find_impossible_motion(const Setup<Dim>& s, const StepGeometry<Dim>& g, const VolumeMismatch& m) {
  if (std::abs(m.net) <= 1e-6 * m.scale) return {};
  std::string who;
  for (std::size_t k = 0; k < s.bodies.size(); ++k)
    if (!g.twists[k].at_rest()) who += (who.empty() ? " by '" : ", '") + s.bodies[k].spec().name + "'";
  return fmt::format(
      "incompressible container, prescribed volume change {:.6g} m^{}/s{}; give the liquid a free surface, "
      "an outflow side, or a motion that keeps the volume",
      -m.net, Dim, who);
}

template <int Dim>
struct Solution {
  PressureRows<Dim> rows;
  CellField<Dim> pressure;
  SolveReport report;
  std::string failure;
};

// Pressure that leaves no liquid cell with a net flux, from the last pressure as first guess.
template <int Dim>
Solution<Dim> solve_pressure(const Setup<Dim>& s, const ProjectionInput<Dim>& in, const StepGeometry<Dim>& g,
                             const CellField<Dim>& guess, const FaceField<Dim>& u_star, PhaseFault fault) {
  Solution<Dim> r{number_rows(in), CellField<Dim>(s.layout), {}, {}};
  const NullSpace closed = find_closed_components(in, r.rows);
  const std::string impossible =
      closed.count == 0 ? "" : find_impossible_motion(s, g, worst_mismatch(in, r.rows, closed));
  if (!impossible.empty()) throw Error(ExitCode::cannot_continue, impossible);
  std::vector<double> b = pressure_right_side(in, r.rows, u_star), x;
  if (fault == PhaseFault::poison && !b.empty()) b[0] = poison;
  for (Site c : r.rows.cells) x.push_back(guess[c]);
  const SolveOptions options{.tolerance = s.scene.solver.tolerance, .preconditioner = s.scene.solver.preconditioner};
  r.report = solve_spd(assemble_pressure_matrix(in, r.rows), row_grid(in, r.rows), closed, b, x, options, s.ranks);
  for (std::size_t n = 0; n < x.size(); ++n) r.pressure[r.rows.cells[n]] = x[n];
  s.halo.fill_ghosts(r.pressure);
  if (!r.report.converged)
    r.failure = fmt::format("the pressure solve stopped at residual {:.2e} after {} iterations", r.report.residual,
                            r.report.iterations);
  return r;
}

template <int Dim>
std::string verify(const Setup<Dim>& s, const CellField<Dim>& phi, const FaceField<Dim>& u_star) {
  std::string text = find_non_finite(s, "phi", s.layout.cells(), phi.data());
  return text.empty() ? find_non_finite(s, "u", u_star) : text;
}

// A step between its phases. Each phase tells the hook and the timers, and leaves what the next ones need.
template <int Dim>
struct StepInProgress {
  const Setup<Dim>& s;
  const State<Dim>& before;
  double dt;
  Phases& phases;
  Attempt<Dim> out;
  FaceField<Dim> u_star;
  Solution<Dim> solution;

  StepInProgress(const Setup<Dim>& setup, const State<Dim>& state, double step, Phases& p)
      : s(setup), before(state), dt(step), phases(p) {
    State<Dim>& next = out.state = state;
    next.time = state.time + dt;
    next.step = state.step + 1;
    next.earlier = state.before;
    next.before = state.now;
    next.dt_before = state.dt_now;
    next.dt_now = dt;
  }

  void transport_surface() {
    const PhaseFault fault = phases.enter("transport");
    const auto timed = phases.timers.measure("surface");
    double added = 0;
    out.state.phi = seiche::transport_surface(s, before, dt, added);
    out.state.expected_volume += added;
    inject(s, fault, out.state.phi.data());
  }

  void measure_geometry() {
    const PhaseFault fault = phases.enter("geometry");
    const auto timed = phases.timers.measure("geometry");
    out.geometry = s.solids.measure(before.time, out.state.time);
    check_geometry_of_step(s, out.geometry, before.time, out.state.time);
    inject(s, fault, out.geometry.faces.closed_flux[0].data());
    out.state.expected_volume += dt * net_inflow(s, out.geometry, before.phi, before.now->u);
    out.state.corrected_volume +=
        control_volume(s, out.geometry.psi, out.state.expected_volume, 0.05 * s.layout.h(), out.state.phi);
  }

  bool transport_velocity() {
    const auto timed = phases.timers.measure("velocity");
    u_star = seiche::transport_velocity(s, before, out.state.phi, dt);
    out.failure = verify(s, out.state.phi, u_star);
    return out.failure.empty();
  }

  ProjectionInput<Dim> input() const {
    return {s.layout, s.halo, s.ranks, out.state.phi, out.geometry.faces, s.density(), dt};
  }

  bool solve() {
    const PhaseFault fault = phases.enter("solve");
    const auto timed = phases.timers.measure("solve");
    solution = solve_pressure(s, input(), out.geometry, before.pressure, u_star, fault);
    out.solve = solution.report;
    out.rows = solution.rows.global;
    out.failure = solution.failure;
    out.state.pressure = solution.pressure;
    return out.failure.empty();
  }

  void restore() {
    const PhaseFault fault = phases.enter("restore");
    const auto timed = phases.timers.measure("restore");
    auto level = std::make_shared<Level<Dim>>(
        restore_velocity(s, input(), solution.rows, out.state.pressure, u_star, out.geometry, out.divergence));
    inject(s, fault, level->u[0].data());
    out.failure = find_non_finite(s, "u", level->u);
    out.state.now = level;
  }
};

}  // namespace

template <int Dim>
Attempt<Dim> attempt_step(const Setup<Dim>& s, const State<Dim>& state, double dt, Phases& phases) {
  StepInProgress<Dim> step(s, state, dt, phases);
  step.transport_surface();
  step.measure_geometry();
  if (step.transport_velocity() && step.solve()) step.restore();
  return std::move(step.out);
}

template Attempt<2> attempt_step<2>(const Setup<2>&, const State<2>&, double, Phases&);
template Attempt<3> attempt_step<3>(const Setup<3>&, const State<3>&, double, Phases&);

}  // namespace seiche
