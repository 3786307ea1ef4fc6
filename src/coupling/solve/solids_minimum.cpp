#include "coupling/solve/solids_minimum.h"

#include "base/scene.h"
#include "base/solver_spec.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/solve/contact_model.h"
#include "coupling/solve/joint_turns.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/state/state.h"

namespace seiche {
namespace {

// Speed of the body's farthest point per unit of each degree of freedom.
template <int Dim>
Eigen::VectorXd unit_speeds(const Solids<Dim>& solids, const SolidCoupling<Dim>& coupling) {
  Eigen::VectorXd speeds(coupling.size());
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
    const Eigen::VectorXd own = solids.at_start[std::size_t(coupling.bodies[b])].unit_speeds();
    speeds.segment(coupling.first[b], own.size()) = own;
  }
  return speeds;
}

// Solves once more, with the impulses of contact given. The last pressure belongs to the last trial of Newton's method,
// not to the point that the line search took. Mean pressures of liquid closed off by bodies follow from the balance of
// the bodies alone.
template <int Dim>
std::string settle(const Solids<Dim>& solids, const SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                   ContactReport& contact) {
  Eigen::VectorXd impulse(problem.size());
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
    const auto k = std::size_t(coupling.bodies[b]);
    const Eigen::VectorXd own = solids.at_start[k].generalised(contact.impulses[k]);
    impulse.segment(coupling.first[b], own.size()) = own;
  }
  const InertiaResponse r = problem.minimise(SparseMatrix(problem.size(), problem.size()), impulse);
  if (r.failure.empty()) contact.velocity = r.velocity;
  return r.failure;
}

// Contact with a liquid solve in each Newton iteration. Starts from the velocities `found` so far, if any.
template <int Dim>
ContactReport solve_in_turns(const Solids<Dim>& solids, const std::vector<ContactMotion>& motions, double dt,
                             double horizon, const SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                             const ContactOptions& options, const ContactReport& found) {
  ContactReport contact =
      solve_contact(*solids.contact, motions, horizon, dt, problem, options, found.velocity, coupling.potential.get());
  const bool touched = contact.failure.empty() && contact.newton_iterations > 0;
  if (touched && !coupling.potential) contact.failure = settle(solids, coupling, problem, contact);
  contact.newton_iterations += found.newton_iterations;
  return contact;
}

// Contact with a model of the added mass. It does not cover bodies that close off liquid. Elastic bodies, or many rigid
// ones, have too many unknowns for it. Returns agreed = false in these cases.
template <int Dim>
ContactInLiquid solve_modelled(const Solids<Dim>& solids, const SolverSpec& solver,
                               const std::vector<ContactMotion>& motions, double dt, double horizon,
                               const SolidCoupling<Dim>& coupling, const InviscidLiquid<Dim>& liquid,
                               const ContactOptions& options, const Eigen::VectorXd& start) {
  const bool of_joints = coupling.joints && coupling.potential == coupling.joints->potential;
  const bool fits = (!coupling.potential || of_joints) && coupling.bodies.size() <= most_modelled;
  if (!liquid.solver || !fits || !liquid.solver->sensed_components().empty()) return {};
  return solve_contact_in_liquid(*solids.contact, motions, horizon, dt, coupling, *liquid.solver, *liquid.problem,
                                 unit_speeds(solids, coupling), solver.tolerance, options, start);
}

// Constraint impulse of the fixed unknowns, the gradient of all energies:
//   R dt = M v - push - (pressure, viscosity) + contact + dt Psi'.
// The solve makes it zero at free unknowns only.
template <int Dim>
Eigen::VectorXd held_part(const SolidCoupling<Dim>& coupling, Eigen::VectorXd residual) {
  for (Eigen::Index i = 0; i < residual.size(); ++i)
    if (!coupling.is_held(i)) residual[i] = 0;
  return residual;
}

// Inputs of the minimum that joints do not change.
template <int Dim>
struct MinimumTask {
  const Setup<Dim>& s;
  const std::vector<ContactMotion>& motions;
  double dt, horizon;
  const SolidCoupling<Dim>& coupling;
  CoupledProblem<Dim>& problem;
  const InviscidLiquid<Dim>& liquid;
  ContactOptions options;
};

// The minimum with the present rates of the joints. `start`: velocities near the solution; `touching`: those of an
// earlier minimum with contact. Either may be empty.
template <int Dim>
ContactReport minimise_once(const MinimumTask<Dim>& t, const Eigen::VectorXd& start, const Eigen::VectorXd& touching) {
  ContactInLiquid modelled = solve_modelled(t.s.solids, t.s.scene->solver, t.motions, t.dt, t.horizon, t.coupling,
                                            t.liquid, t.options, touching);
  ContactReport contact = std::move(modelled.contact);
  if (contact.velocity.size() == 0 && t.problem.notices_indefinite()) contact.velocity = start;
  if (!modelled.agreed && contact.failure.empty())
    contact = solve_in_turns(t.s.solids, t.motions, t.dt, t.horizon, t.coupling, t.problem, t.options, contact);
  return contact;
}

// Speed of the fastest point by which velocities may be corrected without another solve where bodies touch: contact and
// friction are then linear. With elastic solids: what Newton's method leaves.
template <int Dim>
double speed_without_solve(const MinimumTask<Dim>& t, const ContactReport& contact) {
  constexpr double of_gap = 1e-2, of_creep = 0.1;
  if (t.coupling.potential && t.coupling.potential != t.coupling.joints->potential) return t.options.speed_tolerance;
  return std::max(t.options.speed_tolerance,
                  std::min(of_gap * contact.smallest_gap / t.horizon, of_creep * t.options.creep_speed));
}

// Repeats the minimum with corrected rates until the joints are closed where the next solve stands.
template <int Dim>
ContactReport minimise_with_joints(MinimumTask<Dim> t, const Eigen::VectorXd& start) {
  const SolidCoupling<Dim>& coupling = t.coupling;
  t.options.keeps_hessian = true;
  JointTurns<Dim> turns(coupling, t.s.domain.ranks, start.size() > 0 ? start : coupling.joints->velocity_in_state());
  ContactReport contact = minimise_once(t, start, {});
  const Eigen::VectorXd speeds = unit_speeds(t.s.solids, coupling);
  int newton_iterations = 0;
  while (contact.failure.empty()) {
    const bool exact = contact.active > 0 || coupling.potential;
    if (exact) turns.stiffen(contact.hessian);
    const double fastest = exact ? speed_without_solve(t, contact) : 0;
    contact.failure = turns.correct(contact.velocity, [&](const Eigen::VectorXd& change) {
      return exact ? change.cwiseProduct(speeds).cwiseAbs().maxCoeff() <= fastest
                   : change.norm() <= t.s.scene->solver.tolerance * contact.velocity.norm();
    });
    if (!contact.failure.empty() || turns.done()) break;
    newton_iterations += contact.newton_iterations;
    const Eigen::VectorXd from = exact ? contact.velocity : start, touching = exact ? from : Eigen::VectorXd();
    contact = minimise_once(t, from, touching);
  }
  contact.newton_iterations += newton_iterations;
  if (contact.failure.empty()) turns.finish(contact.residual);
  return contact;
}

}  // namespace

template <int Dim>
SolidsMinimum minimise_solids(const Setup<Dim>& s, const State<Dim>& state, double dt, double horizon,
                              const SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                              const InviscidLiquid<Dim>& liquid, const Eigen::VectorXd& start) {
  SolidsMinimum r;
  r.velocity = r.reaction = Eigen::VectorXd::Zero(problem.size());
  if (!s.solids.contact) {
    InertiaResponse response = problem.minimise(SparseMatrix(0, 0), r.velocity);
    r.failure = response.failure;
    if (r.failure.empty()) r.velocity = std::move(response.velocity);
    return r;
  }
  const auto motions = contact_motions(state, horizon);
  const MinimumTask<Dim> task{
      s,        motions,
      dt,       horizon,
      coupling, problem,
      liquid,   contact_options(s.domain, s.scene->domain, s.scene->time, s.fluids.gravity, s.perturbation)};
  ContactReport contact =
      coupling.is_constrained() ? minimise_with_joints(task, start) : minimise_once(task, start, {});
  r.failure = contact.failure;
  r.newton_iterations = contact.newton_iterations;
  r.contacts = contact.active;
  r.friction_settled = contact.friction != FrictionState::unsettled;
  r.impulses = std::move(contact.impulses);
  r.pairs = std::move(contact.pairs);
  r.velocity = std::move(contact.velocity);
  if (coupling.potential && r.failure.empty()) r.reaction = held_part(coupling, std::move(contact.residual));
  return r;
}

#define SEICHE_INSTANTIATE(D)                                                                                          \
  template SolidsMinimum minimise_solids<D>(const Setup<D>&, const State<D>&, double, double, const SolidCoupling<D>&, \
                                            CoupledProblem<D>&, const InviscidLiquid<D>&, const Eigen::VectorXd&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
