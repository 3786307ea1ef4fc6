#include "coupling/step/dry_step.h"

#include "base/scene.h"
#include "coupling/geometry/off_grid.h"
#include "coupling/step/leapfrog.h"
#include "coupling/step/solve_phases.h"
#include "coupling/transport/formula_checks.h"

namespace seiche {
namespace {

template <int Dim>
Moved<Dim> move_off_grid(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, Phases& phases) {
  const auto timed = phases.timers.measure("geometry");
  Moved<Dim> moved{shifted_levels(before, times), {}, {}};
  moved.failure = move_solids(s, before, times, moved.state);
  if (!moved.failure.empty()) return moved;
  moved.geometry = place_off_grid(s.domain.layout, s.solids.bodies, place_at_solve(moved.state, times));
  check_geometry_of_step(s.domain, s.solids, s.scene->domain, moved.geometry, times.start, moved.state.time);
  check_forces_of_step(s.domain, s.fluids, s.sources, times.start, times.start + times.dt);
  return moved;
}

template <int Dim>
void move_second_half_off_grid(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, Phases& phases,
                               Attempt<Dim>& solved) {
  const auto timed = phases.timers.measure("geometry");
  State<Dim>& next = solved.state;
  go_on(solids_can_go_on(s.domain, s.solids, next, times.dt) ? next : before, times, next);
  show_solids(s, next);
  const std::vector<Placement> end = place_bodies(next);
  for (std::size_t k = 0; k < end.size(); ++k) {
    solved.geometry.placed[k].pose = end[k].pose;
    solved.geometry.placed[k].twist.about = end[k].twist.about;
  }
}

}  // namespace

template <int Dim>
Attempt<Dim> attempt_dry_step(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, Phases& phases) {
  Moved<Dim> moved = move_off_grid(s, before, times, phases);
  if (!moved.failure.empty()) {
    Attempt<Dim> failed;
    failed.failure = std::move(moved.failure);
    failed.contradicts = true;
    return failed;
  }
  Attempt<Dim> solved = solve_and_plan(s, before, std::move(moved), Predicted<Dim>(), times, phases);
  if (!solved.failure.empty()) return solved;
  if (times.leapfrog)
    move_second_half_off_grid(s, before, times, phases, solved);
  else
    show_solids(s, solved.state);
  return solved;
}

template Attempt<2> attempt_dry_step<2>(const Setup<2>&, const State<2>&, const StepTimes&, Phases&);
template Attempt<3> attempt_dry_step<3>(const Setup<3>&, const State<3>&, const StepTimes&, Phases&);

}  // namespace seiche
