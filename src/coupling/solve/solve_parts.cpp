#include "coupling/solve/solve_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/solids/joint_motion.h"
#include "coupling/solids/rebound.h"
#include "coupling/state/solids.h"
#include "grid/loops.h"
#include "linalg/core/dense_factors.h"

namespace seiche {
namespace {

constexpr double balanced = 1e-6;  // share of the volume moved: round-off, and the balance of inflow formulas

template <int Dim>
void refuse(const Setup<Dim>& s, const StepGeometry<Dim>& g, const VolumeMismatch& m) {
  const Solids<Dim>& solids = s.solids;
  if (std::abs(m.net) <= balanced * m.scale) return;
  std::string who;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k)
    if (!g.placed[k].twist.at_rest()) who += (who.empty() ? " by '" : ", '") + solids.bodies[k].spec().name + "'";
  for (const Source<Dim>& feed : s.feeds) who += (who.empty() ? " by " : ", ") + feed.name;
  throw Error(ExitCode::cannot_continue,
              fmt::format("incompressible container, prescribed volume change {:.6g} m^{}/s{}; give the liquid a free "
                          "surface, an outflow side, or a motion that keeps the volume",
                          -m.net, Dim, who));
}

// Velocities of pinned nodes over the step that ends at t, less those over the step ahead; 0 at others.
//   w = (u_pin(t) - u_pin(t - dt))/dt - held
template <int Dim>
Eigen::VectorXd pin_lag(const CoupledInput<Dim>& in, const SolidCoupling<Dim>& coupling) {
  Eigen::VectorXd lag = Eigen::VectorXd::Zero(coupling.size());
  const double t = in.state.time, dt = in.liquid.dt;
  for (std::size_t b = 0; b < coupling.bodies.size(); ++b) {
    const Body<Dim>& body = in.setup.solids.bodies[std::size_t(coupling.bodies[b])];
    if (!body.deforms()) continue;
    const Pins before = pins_at(body.elastic(), t - dt), now = pins_at(body.elastic(), t);
    for (std::size_t n = 0; n < now.dofs.size(); ++n) {
      const Eigen::Index i = coupling.first[b] + now.dofs[n];
      lag[i] = (now.targets[n] - before.targets[n]) / dt - coupling.held[i];
    }
  }
  return lag;
}

// Prescribed solids have the velocities of the step that ends at t, pins those of the step ahead. Cells between the two
// that no free node can fill would not balance, though both move alike. There pins take the solids' time.
template <int Dim>
void take_back_lag(const CoupledInput<Dim>& in, const SolidCoupling<Dim>& coupling, const NullSpace& unchanged,
                   const PressureRows<Dim>& rows) {
  Vector flux(rows.cells.size());
  add_multiplied(coupling.J_held, pin_lag(in, coupling), flux);
  for (std::size_t n = 0; n < flux.size(); ++n)
    if (unchanged.component[n] >= 0 && flux[n] != 0) in.geometry.faces.cell_flux.add(rows.cells[n], flux[n]);
}

// J'chi of a closed component; sums below their round-off are 0. Collective.
Eigen::VectorXd felt_by_solids(const BlockColumns& J, const NullSpace& closed, int component,
                               const Communicator& ranks) {
  constexpr double rounding = 1e-10;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(J.columns(), 2);
  J.for_each([&](int i, int k, double value) {
    if (closed.component[std::size_t(i)] != component) return;
    sums(k, 0) += value;
    sums(k, 1) += std::abs(value);
  });
  ranks.global_sum(std::span<double>(sums.data(), std::size_t(sums.size())));
  return (sums.col(0).array().abs() > rounding * sums.col(1).array()).select(sums.col(0), 0.0);
}

// Liquid without a free surface whose volume only jointed bodies change: where their joints leave them no freedom to,
// J'chi = C'y, the joints alone change it by y'(C v). Throws if drives and prescribed solids do. Collective.
// Pockets of a few cells, as where two links meet, are below the grid: they lose or gain what they cannot hold.
template <int Dim>
void refuse_driven(const SolidCoupling<Dim>& coupling, const NullSpace& closed, const std::vector<int>& sensed,
                   const Communicator& ranks) {
  constexpr double pocket = 4;  // cells
  const JointMotion<Dim>& joints = *coupling.joints;
  for (int c = 0; c < closed.count; ++c) {
    if (std::find(sensed.begin(), sensed.end(), c) != sensed.end()) continue;
    const auto own = std::int64_t(std::count(closed.component.begin(), closed.component.end(), c));
    if (ranks.global_sum(own) <= std::int64_t(std::pow(pocket, Dim))) continue;
    const Eigen::VectorXd felt = felt_by_solids(coupling.J, closed, c, ranks);
    if (felt.isZero(0)) continue;
    const Eigen::VectorXd y = shortest_least_squares(Eigen::MatrixXd(coupling.J.constraints.transpose()), felt);
    const Eigen::VectorXd parts = y.cwiseProduct(joints.given);
    if (std::abs(parts.sum()) <=
        balanced * parts.cwiseAbs().sum() + balanced * joints.slack.cwiseAbs().dot(y.cwiseAbs()))
      continue;
    throw Error(ExitCode::cannot_continue,
                fmt::format("joints {} drive solids into liquid that fills a closed container; give the liquid a free "
                            "surface, or a motor with a largest force in place of a drive",
                            joints.names_of_driven(parts)));
  }
}

// Impulses of contact act about the pivots of prescribed solids.
template <int Dim>
double contact_power(const std::vector<BodyImpulse>& impulses, const CoupledInput<Dim>& in) {
  double sum = 0;
  for (std::size_t k = 0; k < impulses.size(); ++k) {
    const Placement& placed = in.geometry.placed[k];
    const Twist led = in.state.solids[k].prescribed_part(placed).twist;
    sum -= impulses[k].linear.dot(led.at(placed.pose.pivot + placed.pose.displacement)) +
           impulses[k].angular.dot(led.angular);
  }
  return sum / in.liquid.dt;
}

}  // namespace

template <int Dim>
void refuse_impossible_motion(const CoupledInput<Dim>& in, const PressureProblem<Dim>& liquid,
                              const SolidCoupling<Dim>& coupling, const std::vector<int>& sensed,
                              const CoupledSolution<Dim>& r) {
  if (liquid.closed.count == 0) return;
  const NullSpace unchanged = without(liquid.closed, sensed);
  if (coupling.any_held()) take_back_lag(in, coupling, unchanged, r.rows);
  if (coupling.is_constrained()) refuse_driven(coupling, liquid.closed, sensed, in.setup.domain.ranks);
  refuse(in.setup, in.geometry, worst_mismatch(in.liquid, r.rows, unchanged));
}

template <int Dim>
void refuse_unbalanced_chambers(const CoupledInput<Dim>& in, const PressureProblem<Dim>& liquid,
                                const std::vector<int>& sensed, const CoupledSolution<Dim>& r) {
  if (r.failure.empty() && !sensed.empty() && r.report.mismatch > balanced)
    refuse(in.setup, in.geometry, worst_mismatch(in.liquid, r.rows, liquid.closed));
}

template <int Dim>
double liquid_tolerance(const CoupledInput<Dim>& in) {
  constexpr double beside_newton = 1e-7;
  const auto& bodies = in.setup.solids.bodies;
  const bool any = std::any_of(bodies.begin(), bodies.end(), [](const Body<Dim>& body) { return body.deforms(); });
  const double asked = in.setup.scene->solver.tolerance;
  return any ? std::min(asked, beside_newton) : asked;
}

template <int Dim>
Vector guessed_pressure(const CoupledInput<Dim>& in, const PressureRows<Dim>& rows) {
  Vector p;
  for (Site c : rows.cells) p.push_back(in.guess[c]);
  return p;
}

template <int Dim>
Eigen::VectorXd find_minimum(const CoupledInput<Dim>& in, SolidCoupling<Dim>& coupling, CoupledProblem<Dim>& problem,
                             const InviscidLiquid<Dim>& inviscid, CoupledSolution<Dim>& r) {
  ImpactsOfSolve<Dim> impacts(in.setup, in.state, coupling, in.horizon);
  r.failure = impacts.act(problem, coupling.push);
  if (!r.failure.empty()) return Eigen::VectorXd::Zero(problem.size());
  SolidsMinimum m = minimise_solids(in.setup, in.state, in.liquid.dt, in.horizon, coupling, problem, inviscid,
                                    in.solids ? *in.solids : Eigen::VectorXd());
  r.failure = m.failure;
  r.newton_iterations = m.newton_iterations;
  r.contacts = m.contacts;
  r.joint_turns = coupling.joints ? coupling.joints->turns : 0;
  r.friction_settled = m.friction_settled;
  r.contact_power = contact_power(m.impulses, in);
  if (r.failure.empty()) r.impacts = impacts.after(m.velocity, m.pairs, in.liquid.dt);
  r.reactions = m.reaction / in.liquid.dt;
  const int earlier = r.report.iterations;
  r.report = problem.report();
  r.report.iterations += earlier;
  for (std::size_t n = 0; n < coupling.cavities.size(); ++n)
    for (const auto& [row, share] : coupling.cavities[n].rows)
      in.geometry.faces.cell_flux.add(r.rows.cells[std::size_t(row)], share * problem.missing_fluxes()[n]);
  return std::move(m.velocity);
}

// A region of enclosed air has one row, on one rank; its pressure is that of all the region's cells.
template <int Dim>
void set_pressure(const CoupledInput<Dim>& in, const Vector& p, CoupledSolution<Dim>& r) {
  std::vector<double> of_air(r.rows.air_row.size());
  for (std::size_t n = 0; n < p.size(); ++n) {
    const Site cell = r.rows.cells[n];
    r.pressure[cell] = p[n];
    if (n >= r.rows.liquid) of_air[std::size_t(r.rows.region(cell))] = p[n];
  }
  if (!of_air.empty()) {
    in.setup.domain.ranks.global_sum(of_air);
    for_each_site(in.liquid.layout, in.liquid.layout.cells(), [&](Site c) {
      if (const std::int64_t k = r.rows.region(c); k >= 0) r.pressure[c] = of_air[std::size_t(k)];
    });
  }
  in.setup.domain.halo.fill_ghosts(r.pressure);
}

#define SEICHE_INSTANTIATE(D)                                                                             \
  template void refuse_impossible_motion<D>(const CoupledInput<D>&, const PressureProblem<D>&,            \
                                            const SolidCoupling<D>&, const std::vector<int>&,             \
                                            const CoupledSolution<D>&);                                   \
  template void refuse_unbalanced_chambers<D>(const CoupledInput<D>&, const PressureProblem<D>&,          \
                                              const std::vector<int>&, const CoupledSolution<D>&);        \
  template double liquid_tolerance<D>(const CoupledInput<D>&);                                            \
  template Vector guessed_pressure<D>(const CoupledInput<D>&, const PressureRows<D>&);                    \
  template Eigen::VectorXd find_minimum<D>(const CoupledInput<D>&, SolidCoupling<D>&, CoupledProblem<D>&, \
                                           const InviscidLiquid<D>&, CoupledSolution<D>&);                \
  template void set_pressure<D>(const CoupledInput<D>&, const Vector&, CoupledSolution<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
