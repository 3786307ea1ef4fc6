#include "coupling/step/drop_phases.h"

#include "coupling/drops/making.h"

namespace seiche {
namespace {

template <int Dim>
DropForces<Dim> forces_of_step(const Setup<Dim>& s, const StepTimes& times) {
  return {s.perturbation.gravity * s.fluids.gravity.of_step(times.start + times.dt, times.dt), s.forces};
}

// Solids of a geometry with the velocities of their unknowns.
template <int Dim>
Obstacles<Dim> obstacles_in(const Setup<Dim>& s, const StepGeometry<Dim>& geometry, const State<Dim>& state) {
  std::vector<Placement> placed = geometry.placed;
  for (std::size_t k = 0; k < placed.size(); ++k) state.solids[k].set_velocity(placed[k]);
  return {s.domain, s.solids.bodies, geometry, std::move(placed)};
}

// Books what left through the sides. Returns why drops cannot fly, or "".
template <int Dim>
std::string fly_and_book(const Setup<Dim>& s, const Obstacles<Dim>& obstacles, const StepTimes& times, double from,
                         double until, State<Dim>& state) {
  const DropForces<Dim> forces = forces_of_step(s, times);
  const DropsThatLeft left = fly(s.domain, obstacles, forces, state.phi, from, until, state.drops.list);
  state.expected_volume -= left.volume;
  state.work.sides -= s.fluids.density() * left.energy;
  return left.is_finite ? "" : "a force gives a drop no finite velocity";
}

}  // namespace

template <int Dim>
std::string land_before_solve(const Setup<Dim>& s, const StepTimes& times, Moved<Dim>& moved) {
  State<Dim>& next = moved.state;
  if (!s.volume_meets_void() || times.looks_ahead() || !s.domain.ranks.any(!next.drops.list.empty())) return {};
  const Obstacles<Dim> obstacles = obstacles_in(s, moved.geometry, next);
  const std::string fault = fly_and_book(s, obstacles, times, times.start, times.start + times.lead, next);
  if (!fault.empty()) return fault;
  merge_drops(s.domain.layout, next.drops.list);
  moved.landed = land_drops(s.domain, obstacles, {s.divergence(), next.room()}, next);
  return {};
}

template <int Dim>
void make_before_solve(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, Moved<Dim>& moved) {
  if (!s.volume_meets_void() || times.looks_ahead()) return;
  const DropForces<Dim> forces = forces_of_step(s, times);
  const Obstacles<Dim> obstacles = obstacles_in(s, moved.geometry, moved.state);
  const CarryingFlow<Dim> flow{before.now->u, moved.geometry.faces, forces, times.start + times.lead / 2, times.lead};
  make_drops(s.domain, obstacles, flow, s.fluids.liquid.spray, moved.landed, moved.state);
  const double rest = times.dt - times.lead;
  for (LandedDrop<Dim>& d : moved.landed)
    d.velocity += forces.gain(d.place, d.velocity, times.start + times.dt - rest / 2, rest);
}

template <int Dim>
std::string fly_after_solve(const Setup<Dim>& s, const StepTimes& times, Attempt<Dim>& solved) {
  State<Dim>& next = solved.state;
  if (!s.volume_meets_void() || !times.leapfrog || !s.domain.ranks.any(!next.drops.list.empty())) return {};
  const Obstacles<Dim> obstacles = obstacles_in(s, solved.geometry, next);
  return fly_and_book(s, obstacles, times, times.start + times.lead, times.start + times.dt, next);
}

#define SEICHE_INSTANTIATE(D)                                                                        \
  template std::string land_before_solve<D>(const Setup<D>&, const StepTimes&, Moved<D>&);           \
  template void make_before_solve<D>(const Setup<D>&, const State<D>&, const StepTimes&, Moved<D>&); \
  template std::string fly_after_solve<D>(const Setup<D>&, const StepTimes&, Attempt<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
