#include "coupling/report/energy_budget.h"

#include <fmt/format.h>

#include "coupling/report/energy_account.h"
#include "coupling/report/measures.h"
#include "coupling/state/attempt.h"
#include "coupling/state/fluids.h"
#include "coupling/state/setup.h"
#include "coupling/state/solids.h"
#include "coupling/tension/surface_tension.h"
#include "coupling/transport/forces.h"
#include "coupling/transport/given_motion.h"
#include "coupling/transport/placed_sources.h"
#include "fluid/boundary/domain.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Speed that round-off and the solver's tolerance may cause, m/s: a thousandth of a cell in a step of mean length. The
// present step's own length would let speeds grow without bound as steps are halved.
template <int Dim>
double jitter_speed(const Domain<Dim>& domain, const State<Dim>& before, double dt) {
  constexpr double still = 1e-3;
  const double mean = before.step > 0 ? before.time / double(before.step) : 0;
  return still * domain.layout.h() / std::max(dt, mean);
}

template <int Dim>
double body_mass(const Solids<Dim>& solids) {
  double sum = 0;
  for (const Body<Dim>& body : solids.bodies) sum += body.mass().mass;
  return sum;
}

template <int Dim>
double total_mass(const Fluids& fluids, const Solids<Dim>& solids, const StepStats& stats) {
  return fluids.density() * stats.liquid_volume + fluids.gas_density() * stats.gas_volume + body_mass(solids);
}

// 2 sigma A_f for each face that the surface crosses, J. The area of these faces is at least that of the surface. The
// factor 2 covers wetted walls. Collective.
template <int Dim>
double surface_energy(const Domain<Dim>& domain, const Fluids& fluids, const CellField<Dim>& phi) {
  if (!fluids.has_surface_tension()) return 0;
  double faces = 0;
  for (int a = 0; a < Dim; ++a)
    faces += local_sum(domain.layout, domain.layout.faces(a), [&](Site f, const IVec<Dim>&) {
      return (phi[f] < 0) != (phi[f - domain.layout.stride(a)] < 0) ? 1.0 : 0.0;
    });
  return 2 * fluids.liquid.surface_tension * domain.ranks.global_sum(faces) * domain.layout.geometry().face_area();
}

// Largest speed of prescribed bodies and pins, m/s.
template <int Dim>
double fastest_led(const Solids<Dim>& solids, const Attempt<Dim>& attempt, double t, double span) {
  std::vector<Placement> placed = attempt.geometry.placed;
  double fastest = 0;
  for (std::size_t k = 0; k < placed.size(); ++k) {
    const Participant<Dim>& solid = attempt.state.solids[k];
    placed[k] = solid.prescribed_part(placed[k]);
    fastest = std::max(fastest, solid.fastest_prescribed_part(t, span));
  }
  return std::max(fastest, solids.geometry.largest_displacement(placed, 1));
}

// p.b/A of prescribed body k on this rank. For an elastic body with moving pins it is an upper bound: all of its
// surface moves at their speed.
template <int Dim>
double pushed_by_body(const Domain<Dim>& domain, const Attempt<Dim>& attempt, std::size_t k, double pinned) {
  double sum = 0;
  const Twist led = attempt.state.solids[k].prescribed_part(attempt.geometry.placed[k]).twist;
  if (led.at_rest() && pinned == 0) return 0;
  for (const FaceShare& share : *attempt.geometry.shares[k]) {
    const IVec<Dim> i = domain.layout.index(share.face);
    if (!domain.layout.faces(share.axis).contains(i)) continue;
    const CellField<Dim>& p = attempt.state.pressure;
    const double jump = p[share.face] - p[share.face - domain.layout.stride(share.axis)];
    if (pinned > 0)
      sum += share.closed * std::abs(jump) * pinned;
    else
      sum += share.closed * jump *
             led.at(extend<Dim>(domain.layout.position(i, face_offset<Dim>(share.axis))))[share.axis];
  }
  return sum;
}

// dt p.b, J, at least 0. Collective.
template <int Dim>
double pushed(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids, const Attempt<Dim>& attempt,
              double t, double dt) {
  double sum = 0;
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    const double pinned = attempt.state.solids[k].fastest_prescribed_part(t, dt);
    sum += pushed_by_body(domain, attempt, k, pinned);
  }
  const double by_bodies = domain.ranks.global_sum(sum) * domain.layout.geometry().face_area();
  const auto flow = attempt.state.exterior->joined_level(domain, fluids, attempt.state);
  const double by_sides = pressure_power_of_sides(domain, fluids, flow->u, flow->u, attempt);
  return std::max(0.0, dt * (by_sides + by_bodies + attempt.powers.feeds));
}

// sqrt(f'M^-1 f) with lumped M, f the tractions and body forces.
template <int Dim>
double pull_of_forces(const Solids<Dim>& solids, double t) {
  double sum = 0;
  for (std::size_t k = 0; k < solids.at_start.size(); ++k) sum += solids.at_start[k].pull(t);
  return std::sqrt(sum);
}

}  // namespace

double most_kinetic_energy(const EnergyBudget& b) {
  const double speed = std::sqrt(2 * (b.kinetic + b.elastic + b.surface)) + std::sqrt(b.mass) * (b.gain + b.given) +
                       b.momentum + std::sqrt(b.pushed);
  return 0.5 * std::pow(speed_margin * speed, 2);
}

// The velocities of solids are those at the end of the horizon, so forces act until then.
template <int Dim>
EnergyBudget energy_budget(const Setup<Dim>& s, const State<Dim>& before, const StepStats& start,
                           const NodeField<Dim>& psi, const Attempt<Dim>& attempt) {
  const double t = before.time, dt = attempt.state.dt_now, span = dt + attempt.state.horizon;
  EnergyBudget b;
  b.kinetic = std::max(start.kinetic_energy, kinetic_energy_of_fluids_before(s.domain, s.fluids, before, psi)) +
              s.fluids.density() * attempt.state.drops.made;
  b.elastic = start.elastic_energy;
  b.surface =
      std::max(surface_energy(s.domain, s.fluids, before.phi), surface_energy(s.domain, s.fluids, attempt.state.phi));
  b.mass = std::max(total_mass(s.fluids, s.solids, start), total_mass(s.fluids, s.solids, attempt.stats));
  b.gain = span * (s.fluids.gravity.of_step(t + dt, dt).norm() + s.fluids.gravity.of_step(t, before.dt_now).norm());
  b.gain += span * largest_field(s.forces, s.domain.layout.geometry(), t, t + span);
  b.given = jitter_speed(s.domain, before, dt) + fastest_led(s.solids, attempt, t, span) +
            std::sqrt(double(Dim)) * fastest_given_flow(s.domain, PlacedSources<Dim>(s, before, t).sources(), t, dt) +
            fastest_dragged(s.domain, s.forces, t, span);
  b.momentum = span * std::max(pull_of_forces(s.solids, t), pull_of_forces(s.solids, t + span));
  b.pushed = pushed(s.domain, s.fluids, s.solids, attempt, t, dt);
  for (const auto& interaction : s.solids.interactions)
    b.pushed += 2 * std::max(0.0, interaction->driven_work(attempt.state, dt));
  return b;
}

template <int Dim>
std::string fault_of_energy(const Setup<Dim>& s, const State<Dim>& before, const StepStats& start,
                            const NodeField<Dim>& psi, const Attempt<Dim>& attempt) {
  const double found = attempt.stats.kinetic_energy;
  if (found <= most_kinetic_energy({.kinetic = start.kinetic_energy}))
    return {};  // within the margin of the initial kinetic energy
  const EnergyBudget budget = energy_budget(s, before, start, psi, attempt);
  const double most = most_kinetic_energy(budget);
  if (found <= most) return {};
  return fmt::format(
      "kinetic energy grows from {:.4g} to {:.4g} {}, but gravity, pressure, solids and sides can supply no more than "
      "{:.4g}: the solution is unstable",
      start.kinetic_energy, found, Dim == 2 ? "J/m" : "J", most);
}

template <int Dim>
std::string fault_of_works(const Domain<Dim>& domain, const Fluids& fluids, const Solids<Dim>& solids,
                           const State<Dim>& before, const StepStats& start, const Attempt<Dim>& attempt) {
  constexpr int begun = 4;
  const Work &was = before.work, &is = attempt.state.work;
  const double created = was.lost_numerical - is.lost_numerical, there = start.kinetic_energy + start.elastic_energy;
  if (before.step < begun || created <= there) return {};
  const double works = std::abs(is.gravity - was.gravity) + std::abs(is.tension - was.tension) +
                       std::abs(is.sides - was.sides) + std::abs(is.solids - was.solids) +
                       std::abs(is.lost_viscous - was.lost_viscous);
  const double h = domain.layout.h(), dt = attempt.state.dt_now,
               mass = std::max(total_mass(fluids, solids, start), total_mass(fluids, solids, attempt.stats)),
               lift = mass * h * fluids.gravity.of_step(before.time + dt, dt).norm(),
               jitter = 0.5 * mass * std::pow(jitter_speed(domain, before, dt), 2),
               made = fluids.density() * attempt.state.drops.made,
               known = there + works + lift + jitter + made + surface_energy(domain, fluids, attempt.state.phi);
  if (created <= known) return {};
  return fmt::format("{:.4g} {} of kinetic energy come from nowhere; there were {:.4g}, work included", created,
                     Dim == 2 ? "J/m" : "J", there + works);
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template EnergyBudget energy_budget<D>(const Setup<D>&, const State<D>&, const StepStats&, const NodeField<D>&,  \
                                         const Attempt<D>&);                                                       \
  template std::string fault_of_works<D>(const Domain<D>&, const Fluids&, const Solids<D>&, const State<D>&,       \
                                         const StepStats&, const Attempt<D>&);                                     \
  template std::string fault_of_energy<D>(const Setup<D>&, const State<D>&, const StepStats&, const NodeField<D>&, \
                                          const Attempt<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
