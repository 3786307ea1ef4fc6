#include "coupling/step/solid_phases.h"

#include "coupling/solids/solid_coupling.h"
#include "coupling/step/leapfrog.h"

namespace seiche {

template <int Dim>
State<Dim> shifted_levels(const State<Dim>& before, const StepTimes& times) {
  State<Dim> next = before;
  next.trial = nullptr;
  next.looks_ahead = false;
  next.time = times.looks_ahead() ? before.time : before.time + times.dt;
  next.step = before.step + 1;
  age(next);
  age(next.exterior->flow);
  next.dt_before = before.dt_now;
  next.dt_now = times.dt;
  next.since_solve = next.volume_lag = times.leapfrog ? times.dt - times.lead : 0;
  return next;
}

// After a look ahead all solids move as it found.
template <int Dim>
std::string move_solids(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, State<Dim>& next) {
  if (!times.looks_ahead()) {
    const std::vector<Eigen::VectorXd> velocities = each_velocity_over(s.solids, before, times.dt);
    const bool looked_ahead = before.trial && before.horizon > 0;
    for (std::size_t k = 0; k < velocities.size(); ++k)
      next.solids[k].advance({s, before, times.dt, times.lead, velocities[k],
                              looked_ahead ? &std::as_const(before.trial->solids)[k] : nullptr});
  }
  std::string failure;
  for (const auto& interaction : s.solids.interactions)
    if (failure.empty()) failure = interaction->settle(s.domain, next, times.start + times.lead);
  return failure;
}

template <int Dim>
std::vector<Placement> place_at_solve(const State<Dim>& next, const StepTimes& times) {
  if (times.leapfrog) return place_halfway(next, times.dt);
  if (!times.looks_ahead()) return place_bodies(next);
  std::vector<Placement> placed;
  for (std::size_t k = 0; k < next.solids.size(); ++k)
    placed.push_back(next.solids[k].place(times.start, times.start + times.dt, times.start));
  return placed;
}

template <int Dim>
void go_on(const State<Dim>& leading, const StepTimes& times, State<Dim>& next) {
  for (std::size_t k = 0; k < next.solids.size(); ++k) next.solids[k].go_on(leading.solids[k], times.lead);
}

template <int Dim>
void show_solids(const Setup<Dim>& s, State<Dim>& state) {
  for (const auto& interaction : s.solids.interactions) interaction->show(s.domain, state);
}

#define SEICHE_INSTANTIATE(D)                                                                         \
  template State<D> shifted_levels<D>(const State<D>&, const StepTimes&);                             \
  template std::string move_solids<D>(const Setup<D>&, const State<D>&, const StepTimes&, State<D>&); \
  template std::vector<Placement> place_at_solve<D>(const State<D>&, const StepTimes&);               \
  template void go_on<D>(const State<D>&, const StepTimes&, State<D>&);                               \
  template void show_solids<D>(const Setup<D>&, State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
