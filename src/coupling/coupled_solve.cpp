#include "coupling/coupled_solve.h"

#include <fmt/format.h>

#include "base/error.h"
#include "coupling/contact_model.h"
#include "coupling/contact_setup.h"
#include "coupling/liquid_problem.h"
#include "coupling/rigid_coupling.h"

namespace seiche {
namespace {

// Throws where a closed, full container cannot do what is asked of it.
template <int Dim>
void refuse_impossible_motion(const Setup<Dim>& s, const StepGeometry<Dim>& g, const VolumeMismatch& m) {
  if (std::abs(m.net) <= 1e-6 * m.scale) return;
  std::string who;
  for (std::size_t k = 0; k < s.bodies.size(); ++k)
    if (!g.placed[k].twist.at_rest()) who += (who.empty() ? " by '" : ", '") + s.bodies[k].spec().name + "'";
  throw Error(ExitCode::cannot_continue,
              fmt::format("incompressible container, prescribed volume change {:.6g} m^{}/s{}; give the liquid a free "
                          "surface, an outflow side, or a motion that keeps the volume",
                          -m.net, Dim, who));
}

// Speed of the farthest point of its body where a degree of freedom is one.
template <int Dim>
Eigen::VectorXd unit_speeds(const Setup<Dim>& s, const SolidCoupling<Dim>& coupling) {
  constexpr int n = twist_size<Dim>;
  Eigen::VectorXd speeds = Eigen::VectorXd::Ones(coupling.size());
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
    const Body<Dim>& body = s.bodies[coupling.bodies[b]];
    if (body.is_rigid()) speeds.segment(coupling.first[b] + Dim, n - Dim).setConstant(body.radius());
  }
  return speeds;
}

// The last pressure belongs to the last trial, not to what the line search made of it; and what liquid that bodies
// close off has as its mean follows from their balance alone. So once more, with the impulses of contact as given.
template <int Dim>
std::string settle(const SolidCoupling<Dim>& coupling, LiquidProblem<Dim>& problem, ContactReport& contact) {
  constexpr int n = twist_size<Dim>;
  Eigen::VectorXd impulse(problem.size());
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
    const BodyImpulse& i = contact.impulses[std::size_t(coupling.bodies[b])];
    impulse.template segment<n>(coupling.first[b]) = stacked<Dim>(i.linear, i.angular);
  }
  const InertiaResponse r = problem.minimise(SparseMatrix(problem.size(), problem.size()), impulse);
  if (r.failure.empty()) contact.velocity = r.velocity;
  return r.failure;
}

// Contact that asks the liquid at every turn of Newton's method, from the velocities `found` by the model if any.
template <int Dim>
ContactReport solve_in_turns(const Setup<Dim>& s, const std::vector<ContactMotion>& motions, double dt, double horizon,
                             const SolidCoupling<Dim>& coupling, LiquidProblem<Dim>& problem,
                             const ContactOptions& options, const ContactReport& found) {
  ContactReport contact =
      solve_contact(*s.contact, motions, horizon, dt, problem, options, found.velocity, coupling.potential.get());
  const bool touched = contact.failure.empty() && contact.newton_iterations > 0;
  if (touched && !coupling.potential) contact.failure = settle(coupling, problem, contact);
  contact.newton_iterations += found.newton_iterations;
  return contact;
}

// Velocities of the bodies; the pressure that goes with them is left in the problem. Bodies that close off liquid are
// beyond the model of the added mass; elastic ones have too many unknowns for it, and so have many rigid ones.
template <int Dim>
Eigen::VectorXd minimise(const Setup<Dim>& s, const State<Dim>& state, double dt, double horizon,
                         const SolidCoupling<Dim>& coupling, const SpdSolver& solver, LiquidProblem<Dim>& problem,
                         CoupledSolution<Dim>& r) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(problem.size());
  if (!s.contact) {
    const InertiaResponse response = problem.minimise(SparseMatrix(0, 0), v);
    r.failure = response.failure;
    r.report = problem.report();
    return r.failure.empty() ? response.velocity : v;
  }
  const auto motions = contact_motions(s, state, horizon);
  const ContactOptions options = contact_options(s);
  ContactReport contact;
  bool agreed = false;
  if (!coupling.potential && solver.sensed_components().empty() && coupling.bodies.size() <= most_modelled) {
    ContactInLiquid modelled = solve_contact_in_liquid(*s.contact, motions, horizon, dt, coupling, solver, problem,
                                                       unit_speeds(s, coupling), s.scene.solver.tolerance, options);
    agreed = modelled.agreed;
    contact = std::move(modelled.contact);
  }
  if (!agreed && contact.failure.empty())
    contact = solve_in_turns(s, motions, dt, horizon, coupling, problem, options, contact);
  r.failure = contact.failure;
  r.newton_iterations = contact.newton_iterations;
  r.contacts = contact.active;
  r.report = problem.report();
  return contact.velocity;
}

// Whether the stiffness of bodies is left to multigrid: where scenes say so, or factors would fill the memory.
template <int Dim>
bool iterates_on_bodies(const Setup<Dim>& s) {
  constexpr double most_bytes = 4e9;
  const std::string& choice = s.scene.solver.elastic;
  const auto is_large = [&](const Body<Dim>& b) {
    return b.is_elastic() && factor_bytes(Dim, b.elastic().body.size()) > most_bytes;
  };
  const bool any_large = std::any_of(s.bodies.begin(), s.bodies.end(), is_large);
  return s.has_elastic() && (choice == "iterate" || (choice == "auto" && any_large));
}

// One solve, with the cells that part given.
template <int Dim>
CoupledSolution<Dim> solve_once(const Setup<Dim>& s, const ProjectionInput<Dim>& in, StepGeometry<Dim>& g,
                                State<Dim>& state, const CellField<Dim>& guess, const FaceField<Dim>& u_star,
                                double horizon, PhaseFault fault) {
  CoupledSolution<Dim> r;
  r.rows = number_rows(in);
  r.pressure = CellField<Dim>(s.layout);
  const NullSpace closed = find_closed_components(in, r.rows);
  r.closed_component = closed.component;
  const SolidCoupling<Dim> coupling = couple_solids(s, g, r.rows, state, in.dt, horizon);
  set_held_velocities(s, coupling, g);
  const double c1 = in.density * in.layout.h() / in.dt, c2 = in.dt * in.layout.geometry().face_area();
  const DistributedMatrix A = assemble_pressure_matrix(in, r.rows);
  const RowGrid grid = row_grid(in, r.rows);
  const SolveOptions options{.tolerance = s.scene.solver.tolerance, .preconditioner = s.scene.solver.preconditioner};
  SpdSolver solver(A, grid, closed, coupling.J, c1 * c2, options, s.ranks);
  // Components whose volume rigid bodies can make up for are left to them.
  if (closed.count > 0)
    refuse_impossible_motion(s, g, worst_mismatch(in, r.rows, without(closed, solver.sensed_components())));
  Vector b = pressure_right_side(in, r.rows, u_star), p;
  if (fault == PhaseFault::poison && !b.empty()) b[0] = std::numeric_limits<double>::quiet_NaN();
  for (Site c : r.rows.cells) p.push_back(guess[c]);
  LiquidProblem<Dim> problem(coupling, solver, b, p, c1, c2, s.ranks);
  const SaddleOptions together{.tolerance = options.tolerance};
  KktSolver kkt({A, grid, closed, coupling.J, c1, c2, Dim}, together, s.ranks);
  if (iterates_on_bodies(s)) problem.solve_together(kkt);
  const Eigen::VectorXd v = minimise(s, state, in.dt, horizon, coupling, solver, problem, r);
  // Chambers that bodies close off are no null space one by one; together they may be.
  constexpr double balanced = 1e-6;  // as refuse_impossible_motion has it
  if (!solver.sensed_components().empty() && r.report.mismatch > balanced)
    refuse_impossible_motion(s, g, worst_mismatch(in, r.rows, closed));
  for (std::size_t n = 0; n < p.size(); ++n) r.pressure[r.rows.cells[n]] = p[n];
  s.halo.fill_ghosts(r.pressure);
  if (r.failure.empty()) set_velocities(s, coupling, v, g, state);
  for (RigidState& body : state.rigid) body.horizon = horizon;
  return r;
}

constexpr int most_policies = 50;
// Pressures this many solver tolerances below zero pull.
constexpr double pull = 10;

void add_up(SolveReport& all, const SolveReport& one) {
  const int iterations = all.iterations + one.iterations;
  all = one;
  all.iterations = iterations;
}

}  // namespace

// 0 <= p, 0 <= net flux + missing flux, one of them zero: policy iteration over the set of parted cells.
template <int Dim>
CoupledSolution<Dim> solve_coupled(const Setup<Dim>& s, const ProjectionInput<Dim>& in, StepGeometry<Dim>& g,
                                   State<Dim>& state, const CellField<Dim>& guess, const FaceField<Dim>& u_star,
                                   double horizon, PhaseFault fault) {
  if (!in.parting) return solve_once(s, in, g, state, guess, u_star, horizon, fault);
  start_parting(in, state.parting);
  const StepGeometry<Dim> still = g;
  const std::vector<RigidState> rigid = state.rigid;
  const std::vector<ElasticMotion> elastic = state.elastic;
  CoupledSolution<Dim> r;
  CellField<Dim> from = guess;
  CellField<Dim, char> eligible;
  for (int k = 0; k < most_policies; ++k) {
    g = still;
    state.rigid = rigid;
    state.elastic = elastic;
    CoupledSolution<Dim> trial = solve_once(s, in, g, state, from, u_star, horizon, fault);
    add_up(r.report, trial.report);
    std::swap(trial.report, r.report);
    r = std::move(trial);
    if (!r.failure.empty()) return r;
    if (k == 0) eligible = cells_that_may_part(in, r.rows, r.closed_component);
    from = r.pressure;
    if (!revise_parting(in, r.rows, r.pressure, u_star, eligible, pull * s.scene.solver.tolerance, state.parting))
      return r;
  }
  r.failure = fmt::format("where the liquid parts from the solids is not settled after {} solves", most_policies);
  return r;
}

#define SEICHE_INSTANTIATE(D)                                                                                \
  template CoupledSolution<D> solve_coupled<D>(const Setup<D>&, const ProjectionInput<D>&, StepGeometry<D>&, \
                                               State<D>&, const CellField<D>&, const FaceField<D>&, double,  \
                                               PhaseFault);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
