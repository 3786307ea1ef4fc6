#include "coupling/step/leapfrog.h"

#include "base/time_spec.h"
#include "coupling/solids/contact_setup.h"
#include "coupling/solids/end_of_step.h"
#include "coupling/state/features.h"
#include "coupling/state/solids.h"
#include "coupling/state/source.h"
#include "coupling/transport/sources.h"
#include "fluid/boundary/domain.h"

namespace seiche {
namespace {

// True if the source opens or closes in the step. Its first liquid has no velocity for the second half step yet.
template <int Dim>
bool opens_or_closes(const Source<Dim>& source, double t0, double t1) {
  return open_in_step(source.spec, t0, t1) && (source.spec.from >= t0 || source.spec.until < t1);
}

}  // namespace

bool may_leapfrog(const Features& features) {
  return features.has(Feature::leapfrog);
}

template <int Dim>
bool is_leapfrog_step(const Solids<Dim>& solids, const std::vector<Source<Dim>>& sources, const Features& features,
                      const State<Dim>& state, double dt) {
  for (const Source<Dim>& source : sources)
    if (opens_or_closes(source, state.time, state.time + dt)) return false;
  return may_leapfrog(features) && (!solids.has_unknowns() || safe_share(solids, state, 2 * dt) >= 1);
}

template <int Dim>
bool can_go_on(const Domain<Dim>& domain, const Solids<Dim>& solids, const TimeSpec& time, const State<Dim>& halfway,
               double dt) {
  // Redistancing covers ceil(cfl) + 1 layers. Before it, this velocity moves the surface over two half steps.
  const double h = domain.layout.h(), most = std::ceil(time.cfl) + 1;
  return fastest_component(domain, halfway) * dt <= most * h && solids_can_go_on(domain, solids, halfway, dt);
}

template <int Dim>
bool solids_can_go_on(const Domain<Dim>& domain, const Solids<Dim>& solids, const State<Dim>& halfway, double dt) {
  if (!solids.has_unknowns()) return true;
  std::vector<Placement> placed = place_bodies(halfway);
  for (std::size_t k = 0; k < placed.size(); ++k) halfway.solids[k].set_velocity(placed[k]);
  // One cell a step, with an allowance for solids that speed up.
  constexpr double speeding = 1.1;
  return solids.geometry.largest_displacement(placed, dt) <= speeding * domain.layout.h() &&
         safe_share(solids, halfway, dt / 2) >= 1;
}

template <int Dim>
std::vector<Placement> place_halfway(const State<Dim>& state, double dt) {
  std::vector<Placement> placed;
  for (std::size_t k = 0; k < state.solids.size(); ++k)
    placed.push_back(state.solids[k].place(state.time - state.dt_now, state.time, state.time - dt / 2));
  return placed;
}

template <int Dim>
StepGeometry<Dim> placed_at_end(const Solids<Dim>& solids, const State<Dim>& end, StepGeometry<Dim> solved) {
  place_at(solids.geometry.measure(place_bodies(end), end.time), solved);
  return solved;
}

#define SEICHE_INSTANTIATE(D)                                                                                          \
  template bool is_leapfrog_step<D>(const Solids<D>&, const std::vector<Source<D>>&, const Features&, const State<D>&, \
                                    double);                                                                           \
  template bool can_go_on<D>(const Domain<D>&, const Solids<D>&, const TimeSpec&, const State<D>&, double);            \
  template bool solids_can_go_on<D>(const Domain<D>&, const Solids<D>&, const State<D>&, double);                      \
  template std::vector<Placement> place_halfway<D>(const State<D>&, double);                                           \
  template StepGeometry<D> placed_at_end<D>(const Solids<D>&, const State<D>&, StepGeometry<D>);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
