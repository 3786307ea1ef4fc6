// One time step, as the algorithm reads: move surface and solids, predict the velocity, solve, restore.
#include "coupling/step/step.h"

#include "base/scene.h"
#include "coupling/state/dry.h"
#include "coupling/step/drop_phases.h"
#include "coupling/step/dry_step.h"
#include "coupling/step/leapfrog.h"
#include "coupling/step/solve_phases.h"
#include "coupling/step/surface_phases.h"
#include "coupling/transport/prescribed_flow.h"
#include "coupling/transport/tracked_volume.h"

namespace seiche {
namespace {

template <int Dim>
StepTimes times_of_step(const Solids<Dim>& solids, const std::vector<Source<Dim>>& sources, const Features& features,
                        const State<Dim>& before, double dt) {
  if (before.looks_ahead) return {before.time, dt, 0, false};
  const bool leapfrog = is_leapfrog_step(solids, sources, features, before, dt);
  return {before.time, dt, leapfrog ? dt / 2 : dt, leapfrog};
}

template <int Dim>
Attempt<Dim> failed(std::string why, bool contradicts = false) {
  Attempt<Dim> attempt;
  attempt.failure = std::move(why);
  attempt.contradicts = contradicts;
  return attempt;
}

// As a step whose velocity the scene gives by formulas.
template <int Dim>
Attempt<Dim> attempt_prescribed_step(const Setup<Dim>& s, const State<Dim>& before, double dt, Phases& phases) {
  std::string fault = fault_of_prescribed(s.domain, s.fluids, s.scene->time, before, dt);
  if (!fault.empty()) return failed<Dim>(std::move(fault));
  Moved<Dim> moved =
      move_surface_and_solids(s, before, times_of_step(s.solids, s.sources, s.features, before, dt), phases);
  if (!moved.failure.empty()) return failed<Dim>(std::move(moved.failure), true);
  Attempt<Dim> attempt = prescribe_velocity(s.domain, s.fluids, std::move(moved));
  if (s.tracks_volume() && attempt.failure.empty()) attempt.failure = fault_of_volume(s.domain, before, attempt.state);
  return attempt;
}

}  // namespace

template <int Dim>
Attempt<Dim> attempt_step(const Setup<Dim>& s, const State<Dim>& before, double dt, Phases& phases) {
  if (s.fluids.has_prescribed_flow()) return attempt_prescribed_step(s, before, dt, phases);
  const StepTimes times = times_of_step(s.solids, s.sources, s.features, before, dt);
  if (is_dry(s)) return attempt_dry_step(s, before, times, phases);
  Moved<Dim> moved = move_surface_and_solids(s, before, times, phases);
  if (!moved.failure.empty()) return failed<Dim>(std::move(moved.failure), true);
  Predicted<Dim> predicted = predict_velocity(s, before, moved, times, phases);
  if (!predicted.failure.empty()) return failed<Dim>(predicted.failure);
  const std::optional<CellField<Dim, char>> closed = std::exchange(moved.closed, std::nullopt);
  std::optional<NodeField<Dim>> psi_at_solve;  // where the solve will move solids to the end of the step
  if (s.volume_lags() && moved.end) psi_at_solve = moved.geometry.psi;
  Attempt<Dim> solved = s.volume_meets_void()
                            ? solve_within_room(s, before, std::move(moved), std::move(predicted), times, phases)
                            : solve_and_plan(s, before, std::move(moved), predicted, times, phases);
  if (s.volume_lags())
    keep_level_of_volumes(s.domain, psi_at_solve ? *psi_at_solve : solved.geometry.psi, s.divergence(), solved.state);
  if (times.leapfrog && solved.failure.empty()) move_second_half(s, before, times, *closed, phases, solved);
  if (solved.failure.empty() && !times.leapfrog) show_solids(s, solved.state);
  if (solved.failure.empty()) solved.failure = fly_after_solve(s, times, solved);
  if (s.tracks_volume() && solved.failure.empty()) solved.failure = fault_of_volume(s.domain, before, solved.state);
  return solved;
}

template Attempt<2> attempt_step<2>(const Setup<2>&, const State<2>&, double, Phases&);
template Attempt<3> attempt_step<3>(const Setup<3>&, const State<3>&, double, Phases&);

}  // namespace seiche
