#include "coupling/report/measures.h"

#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/solids/prescribed_loads.h"
#include "coupling/solids/pressure_loads.h"
#include "coupling/state/fluids.h"
#include "coupling/state/solids.h"
#include "coupling/transport/transport.h"
#include "fluid/boundary/domain.h"
#include "fluid/volume/own_side.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Larger speed on the faces of a cell along an axis that the fluid touches.
template <int Dim>
double fastest_solved(const Domain<Dim>& domain, const TimeLevel<Dim>& l, int axis, Site cell) {
  double fastest = 0;
  for (const Site f : {cell, cell + domain.layout.stride(axis)})
    if (l.valid.at(axis, f)) fastest = std::max(fastest, std::abs(l.u.at(axis, f)));
  return fastest;
}

// Sums for one fluid over this rank's cells.
struct FluidSums {
  std::array<double, 7> sums{};  // volume, kinetic and potential energy, momentum, cells
  double fastest_squared = 0;
};

// E_kin = sum_cells rho V sum_a (u_low^2 + u_high^2)/4, momentum = sum rho V (u_low + u_high)/2, E_pot = -sum rho V
// g.x with gravity at that time; the fluid is where phi < 0.
template <int Dim>
FluidSums sum_fluid(const Domain<Dim>& domain, const TimeLevel<Dim>& level, const CellField<Dim>& phi,
                    const NodeField<Dim>& psi, const Room<Dim>& room, double density, const Vec<Dim>& g) {
  FluidSums r;
  for_each_index_in_order(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>& i) {
    if (phi[c] > 2 * domain.layout.h()) return;
    const double volume = domain.layout.geometry().cell_volume() * liquid_share(domain.layout, room, phi, psi, c);
    const double mass = density * volume;
    double speed2 = 0;
    for (int a = 0; a < Dim; ++a) {
      const FacePair u = solved_faces(domain.layout, level, a, c);
      r.sums[1] += 0.25 * mass * (u.low * u.low + u.high * u.high);
      r.sums[3 + a] += 0.5 * mass * (u.low + u.high);
      speed2 += std::pow(fastest_solved(domain, level, a, c), 2);
    }
    r.sums[0] += volume;
    r.sums[2] -= mass * g.dot(domain.layout.position(i, cell_offset<Dim>()));
    if (phi[c] < 0) r.fastest_squared = std::max(r.fastest_squared, speed2), r.sums[6] += 1;
  });
  return r;
}

// The same where phi >= 0; zero without such a level.
template <int Dim>
FluidSums sum_gas(const Domain<Dim>& domain, const std::shared_ptr<const TimeLevel<Dim>>& level,
                  const CellField<Dim>& phi, const NodeField<Dim>& psi, const Room<Dim>& room, double density,
                  const Vec<Dim>& g) {
  if (!level) return {};
  CellField<Dim> negated(domain.layout);
  for_each_site(domain.layout, domain.layout.padded(), [&](Site c) { negated[c] = -phi[c]; });
  return sum_fluid(domain, *level, negated, psi, room, density, g);
}

}  // namespace

template <int Dim>
void measure_fluids(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, const NodeField<Dim>& psi,
                    StepStats& stats) {
  const Vec<Dim> g = truncate<Dim>(fluids.gravity.at(state.time));
  FluidSums liquid = sum_fluid(domain, *state.now, state.phi, psi, state.room(), fluids.density(), g),
            gas = sum_gas(domain, state.exterior->flow.now, state.phi, psi, state.room(), fluids.gas_density(), g);
  domain.ranks.global_sum(liquid.sums);
  domain.ranks.global_sum(gas.sums);
  stats.liquid_volume = liquid.sums[0];
  stats.gas_volume = gas.sums[0];
  stats.kinetic_energy = liquid.sums[1] + gas.sums[1];
  stats.potential_energy = liquid.sums[2] + gas.sums[2];
  for (int a = 0; a < 3; ++a) stats.momentum[a] = liquid.sums[3 + a] + gas.sums[3 + a];
  stats.max_speed = std::sqrt(domain.ranks.global_max(std::max(liquid.fastest_squared, gas.fastest_squared)));
  stats.cells_liquid = std::int64_t(liquid.sums[6]);
  stats.volume_corrected = state.corrected_volume;
  state.exterior->measure(domain, psi, state.phi, stats);
}

template <int Dim>
double kinetic_energy_of_fluids_before(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state,
                                       const NodeField<Dim>& psi) {
  if (!state.before) return 0;
  const Vec<Dim> g = Vec<Dim>::Zero();
  const FluidSums liquid = sum_fluid(domain, *state.before, state.phi, psi, state.room(), fluids.density(), g),
                  gas = sum_gas(domain, state.exterior->flow.before, state.phi, psi, state.room(), fluids.gas_density(),
                                g);
  return domain.ranks.global_sum(liquid.sums[1] + gas.sums[1]);
}

template <int Dim>
void measure_bodies(const Fluids& fluids, const TimeSpec& time, const State<Dim>& state, StepStats& stats) {
  for (std::size_t k = 0; k < state.solids.size(); ++k) state.solids[k].measure(fluids.gravity, time, state, stats);
}

// Loads of the pressure on the faces that each solid closes, plus those that state and solids keep.
template <int Dim>
std::vector<SolidState> measure_solids(const Setup<Dim>& setup, const State<Dim>& state, const StepGeometry<Dim>& g) {
  const Solids<Dim>& solids = setup.solids;
  std::vector<SolidState> states;
  const std::vector<SolidLoad> by_pressure = pressure_loads(setup.domain, solids, g, state.pressure),
                               beyond = loads_beyond_faces(setup, g, state);
  for (std::size_t k = 0; k < solids.bodies.size(); ++k) {
    const Pose& pose = g.placed[k].pose;
    const Eigen::Quaterniond q(pose.rotation);
    SolidState& out = states.emplace_back();
    out.name = solids.bodies[k].spec().name;
    out.position = pose.apply(solids.bodies[k].reference_point());
    out.orientation = {q.w(), q.x(), q.y(), q.z()};
    out.velocity = g.placed[k].twist.at(out.position);
    out.angular_velocity = g.placed[k].twist.angular;
    state.solids[k].describe(setup.scene->time, state, out);
    for (const std::vector<SolidLoad>* loads : {&by_pressure, &state.viscous_loads, &state.convected_loads})
      if (!loads->empty()) out.force += (*loads)[k].force, out.torque += (*loads)[k].torque;
    out.force += out.unseen_force = beyond[k].force;
    out.torque += out.unseen_torque = beyond[k].torque;
    state.solids[k].add_loads(out);
  }
  return states;
}

#define SEICHE_INSTANTIATE(D)                                                                                         \
  template void measure_fluids<D>(const Domain<D>&, const Fluids&, const State<D>&, const NodeField<D>&, StepStats&); \
  template double kinetic_energy_of_fluids_before<D>(const Domain<D>&, const Fluids&, const State<D>&,                \
                                                     const NodeField<D>&);                                            \
  template void measure_bodies<D>(const Fluids&, const TimeSpec&, const State<D>&, StepStats&);                       \
  template std::vector<SolidState> measure_solids<D>(const Setup<D>&, const State<D>&, const StepGeometry<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
