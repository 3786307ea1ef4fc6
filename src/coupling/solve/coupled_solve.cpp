#include "coupling/solve/coupled_solve.h"

#include <optional>

#include "base/scene.h"
#include "base/solver_spec.h"
#include "coupling/solids/end_of_step.h"
#include "coupling/solids/known_loads.h"
#include "coupling/solids/sealed_liquid.h"
#include "coupling/solve/solve_parts.h"
#include "coupling/solve/viscous_solve.h"
#include "coupling/state/dry.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"
#include "fluid/pressure/separation_search.h"

namespace seiche {
namespace {

// True if bodies are solved for by iteration, without factors: the scene says so, or factors would need over 4 GB. Not
// with joints, whose rows need factors.
template <int Dim>
bool iterates_on_bodies(const Solids<Dim>& solids, const SolverSpec& solver, const SolidCoupling<Dim>& coupling) {
  constexpr double most_bytes = 4e9;
  const std::string& choice = solver.elastic;
  const bool any_large =
      solids.at_start.any([](const Participant<Dim>& p) { return factor_bytes(Dim, p.unknowns()) > most_bytes; });
  return coupling.potential && !coupling.is_constrained() && (choice == "iterate" || (choice == "auto" && any_large));
}

// Solves for pressure and bodies. r.u_star and coupling.push are those without pressure.
template <int Dim>
void solve_pressure(const CoupledInput<Dim>& input, const PressureProblem<Dim>& liquid, SolidCoupling<Dim>& coupling,
                    CoupledSolution<Dim>& r) {
  const Setup<Dim>& s = input.setup;
  const ProjectionInput<Dim>& in = input.liquid;
  const double c1 = in.density * in.layout.h() / in.dt, c2 = in.dt * in.layout.geometry().face_area();
  const SolveOptions options{
      .tolerance = liquid_tolerance(input), .preconditioner = s.scene->solver.preconditioner, .jumps = in.has_gas()};
  SpdSolver solver(liquid.A, liquid.grid, liquid.closed, coupling.J, c1 * c2, options, s.domain.ranks);
  refuse_impossible_motion(input, liquid, coupling, solver.sensed_components(), r);
  Vector b = pressure_right_side(in, r.rows, r.u_star), p = guessed_pressure(input, r.rows);
  for (double& flux : b) flux *= s.perturbation.divergence;
  if (input.fault == PhaseFault::poison && !b.empty()) b[0] = std::numeric_limits<double>::quiet_NaN();
  LiquidProblem<Dim> problem(coupling, solver, liquid.closed, b, p, c1, c2, s.domain.ranks);
  KktSolver kkt({liquid.A, liquid.grid, liquid.closed, coupling.J, c1, c2, Dim}, {.tolerance = options.tolerance},
                s.domain.ranks);
  if (iterates_on_bodies(s.solids, s.scene->solver, coupling)) problem.solve_together(kkt);
  r.solids = find_minimum(input, coupling, problem, {&solver, &problem}, r);
  refuse_unbalanced_chambers(input, liquid, solver.sensed_components(), r);
  if (!is_dry(s)) set_pressure(input, p, r);
}

// One solve with a given set of cells separated from walls.
template <int Dim>
CoupledSolution<Dim> solve_once(const CoupledInput<Dim>& input) {
  const Setup<Dim>& s = input.setup;
  CoupledSolution<Dim> r;
  const bool dry = is_dry(s);
  if (!dry) {
    r.rows = number_rows(input.liquid);
    r.pressure = CellField<Dim>(s.domain.layout);
    r.u_star = input.u_star;
  }
  const PressureProblem<Dim> liquid = dry ? PressureProblem<Dim>() : PressureProblem<Dim>(input.liquid, r.rows);
  r.closed_component = liquid.closed.component;
  SolidCoupling<Dim> coupling =
      couple_solids(s, input.geometry, r.rows, liquid.closed, input.state, input.liquid.dt, input.horizon);
  push_by(input.convected, s.domain, r.rows, input.liquid.dt, coupling);
  if (input.known_loads) push_by(*input.known_loads, input.state.solids, input.geometry, input.liquid.dt, coupling);
  set_held_velocities(s.domain, coupling, input.geometry);
  take_prescribed_fluxes(s.domain, input.geometry, r.rows, coupling.cavities);
  if (input.flux_of_end) add_flux_of_end(s.domain, r.rows, liquid.closed, *input.flux_of_end, input.geometry.faces);
  const ViscousRoute route = input.viscosity
                                 ? choose_route(s.domain, s.fluids, s.solids, coupling.J, s.scene->solver.viscosity,
                                                *input.viscosity, input.liquid.dt)
                                 : ViscousRoute::none;
  if (route == ViscousRoute::coupled) {
    solve_with_viscosity(input, liquid, coupling, r);
  } else {
    std::optional<SplitViscosity<Dim>> viscosity;
    if (route == ViscousRoute::split) viscosity.emplace(input, coupling, r).act(liquid, coupling, r);
    if (r.failure.empty()) solve_pressure(input, liquid, coupling, r);
    if (viscosity && r.failure.empty()) viscosity->measure(r);
  }
  if (r.failure.empty()) {
    set_velocities(s.domain, s.solids, coupling, r.solids, input.horizon, input.geometry, input.state);
    set_reactions(coupling, r.reactions, input.state);
    mark_sealed(s.domain, s.solids, r.rows, coupling.cavities, input.state);
  }
  return r;
}

// Pressures below zero by more than this many solver tolerances count as suction.
constexpr double pull = 10;

void add_up(SolveReport& all, const SolveReport& one) {
  const int iterations = all.iterations + one.iterations;
  all = one;
  all.iterations = iterations;
}

}  // namespace

// Policy iteration over the cells separated from walls, one solve for each guess of them. Every solve starts from the
// same state and from the pressure of the one before.
template <int Dim>
CoupledSolution<Dim> solve_coupled(const CoupledInput<Dim>& input) {
  const ProjectionInput<Dim>& in = input.liquid;
  if (!in.separation) return solve_once(input);
  State<Dim>& state = input.state;
  SeparationSearch<Dim> search(in, pull * input.setup.scene->solver.tolerance, input.separated, state.separation);
  const StepGeometry<Dim> still = input.geometry;
  const Participants<Dim> solids = state.solids;
  CoupledSolution<Dim> r;
  CellField<Dim> from = input.guess;
  Eigen::VectorXd moving = input.solids ? *input.solids : Eigen::VectorXd();
  do {
    input.geometry = still;
    state.solids = solids;
    CoupledSolution<Dim> trial =
        solve_once(CoupledInput<Dim>{input.setup, in, input.geometry, state, from, input.slope, input.flow,
                                     input.u_star, input.convected, input.flux_of_end, input.horizon, input.viscosity,
                                     input.fault, input.at_walls, &moving, nullptr, input.known_loads});
    add_up(r.report, trial.report);
    std::swap(trial.report, r.report);
    r = std::move(trial);
    if (!r.failure.empty()) return r;
    from = r.pressure;
    moving = r.solids;
  } while (!search.has_converged_with(r.rows, r.closed_component, r.pressure, r.u_star));
  r.separation_error = search.error();
  return r;
}

template CoupledSolution<2> solve_coupled<2>(const CoupledInput<2>&);
template CoupledSolution<3> solve_coupled<3>(const CoupledInput<3>&);

}  // namespace seiche
