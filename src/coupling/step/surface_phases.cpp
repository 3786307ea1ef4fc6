#include "coupling/step/surface_phases.h"

#include "base/scene.h"
#include "base/time_spec.h"
#include "coupling/solids/sealed_liquid.h"
#include "coupling/step/checks.h"
#include "coupling/step/drop_phases.h"
#include "coupling/step/leapfrog.h"
#include "coupling/step/side_flow.h"
#include "coupling/step/wave_absorption.h"
#include "coupling/thin/liquid_beside.h"
#include "coupling/thin/thin_solids.h"
#include "coupling/transport/feeds.h"
#include "coupling/transport/formula_checks.h"
#include "coupling/transport/level_in_solids.h"
#include "coupling/transport/prescribed_flow.h"
#include "coupling/transport/sources.h"
#include "coupling/transport/tracked_volume.h"
#include "coupling/transport/transport.h"
#include "grid/loops.h"
#include "levelset/redistance.h"

namespace seiche {
namespace {

// Flags of the deforming bodies that no unknown moves by a tenth of a cell in the step.
template <int Dim>
std::vector<char> slow_bodies(const Domain<Dim>& domain, const State<Dim>& next, const StepGeometry<Dim>& geometry,
                              double dt) {
  constexpr double slow = 0.1;
  std::vector<char> flags;
  for (std::size_t k = 0; k < next.solids.size(); ++k) {
    const Eigen::VectorXd v = next.solids[k].velocity();
    const double way = v.size() > 0 ? dt * v.template lpNorm<Eigen::Infinity>() : 0;
    flags.push_back(geometry.deforms(int(k)) && way < slow * domain.layout.h());
  }
  return flags;
}

template <int Dim>
StepGeometry<Dim> measure_geometry(const Domain<Dim>& domain, const Solids<Dim>& solids, const DomainSpec& extent,
                                   const State<Dim>& next, const StepTimes& times, Phases& phases) {
  const PhaseFault fault = phases.enter("geometry");
  const auto timed = phases.timers.measure("geometry");
  StepGeometry<Dim> geometry = solids.geometry.measure(place_at_solve(next, times), next.time);
  geometry.slow = slow_bodies(domain, next, geometry, times.dt);
  check_geometry_of_step(domain, solids, extent, geometry, times.start, next.time);
  inject(domain, fault, geometry.faces.closed_flux[0]);
  return geometry;
}

// Null in the first step, unless a trial of it tells how the flow starts.
template <int Dim>
std::shared_ptr<const EndOfStep<Dim>> find_end(const Domain<Dim>& domain, const Fluids& fluids,
                                               const Solids<Dim>& solids, const State<Dim>& before,
                                               const StepTimes& times, const Moved<Dim>& moved, Phases& phases) {
  if (!times.leapfrog || !fits_end_of_step(fluids, solids)) return nullptr;
  if (before.step == 0 && !before.trial) return nullptr;
  const auto timed = phases.timers.measure("geometry");
  const State<Dim>& known = before.trial ? *before.trial : before;
  return end_of_step(domain, solids, known, moved.state, moved.geometry, times.dt);
}

// Room in cells beside solids at distance psi (m), less gaps at walls, and through `open` shares of faces.
template <int Dim>
std::shared_ptr<const OpenParts<Dim>> room_beside(const Domain<Dim>& domain, const NodeField<Dim>& psi,
                                                  const PagedFaceField<Dim>& open, const Separation<Dim>& separation) {
  auto parts = std::make_shared<OpenParts<Dim>>(measure_open_parts(domain.layout, domain.halo, psi, open));
  if (separation.gap.empty()) return parts;
  for (const Site c : listed_possible(
           domain.layout, domain.layout.cells(), [](Site) { return true; },
           [&](Site cell) { return separation.gap[cell] > 0; }))
    parts->cells.set(c, std::max(0.0, parts->cells[c] - separation.gap[c]));
  fill_open_ghosts(domain.layout, domain.halo, *parts);
  return parts;
}

// Room in cells where the solids are at the solve, and through faces where its velocities fit them.
template <int Dim>
std::shared_ptr<const OpenParts<Dim>> room_at_solve(const Domain<Dim>& domain, const Moved<Dim>& moved) {
  const StepGeometry<Dim>& fitted = moved.end ? moved.end->geometry : moved.geometry;
  return room_beside(domain, moved.geometry.psi, fitted.faces.open, moved.state.separation);
}

// Empty volume at walls that phi still counts as liquid, m^Dim.
template <int Dim>
double gap_volume(const Domain<Dim>& domain, const Fluids& fluids, const Separation<Dim>& separation) {
  if (!fluids.liquid.separates) return 0;
  const double cells =
      local_sum(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) { return separation.gap[c]; });
  return domain.ranks.global_sum(cells) * domain.layout.geometry().cell_volume();
}

// The most that the volume control moves the surface by, m.
template <int Dim>
double largest_shift(const Domain<Dim>& domain) {
  return 0.05 * domain.layout.h();
}

// Carries the surface on; books volume and energy of sources. Returns the share of each cell that they brought.
template <int Dim>
std::optional<CellField<Dim>> transport_and_book(const Setup<Dim>& s, const State<Dim>& at, FaceField<Dim> path,
                                                 double from, double span, const CellField<Dim, char>& closed,
                                                 State<Dim>& next) {
  Brought<Dim> brought =
      transport_surface(s, at, std::move(path), from, span, PlacedSources<Dim>(s, next, from + span), closed, next.phi);
  if (s.tracks_volume()) return std::move(brought.share);
  next.expected_volume += brought.volume;
  next.work.sides += s.fluids.density() * brought.kinetic;
  return std::move(brought.share);
}

// to + (1 - part) (from - to) on all faces.
template <int Dim>
void blend(const Layout<Dim>& layout, const FaceField<Dim>& from, double part, FaceField<Dim>& to) {
  for (int a = 0; a < Dim; ++a)
    for_each_site(layout, layout.padded(), [&](Site f) {
      if (from.at(a, f) != to.at(a, f)) to.at(a, f) += (1 - part) * (from.at(a, f) - to.at(a, f));
    });
}

// A span in which volumes are carried with the flow of a state.
template <int Dim>
struct VolumeSpan {
  const State<Dim>& leading;        // its flow
  double from, until;               // s
  const OpenParts<Dim>* open;       // room at `from`; null: whole
  const CellField<Dim>& level_set;  // at `from`, m
};

// Carries the volumes of cells. Where initial velocities need not fit, the first step takes what its trial found, or
// without gas and beside solids that move a part of that (share_of_trial()); the trial itself carries nothing. Empty,
// or what fails.
template <int Dim>
std::string carry_volumes(const Setup<Dim>& s, const VolumeSpan<Dim>& span, const FaceField<Dim>& u, State<Dim>& next) {
  const State<Dim>& before = span.leading;
  const bool sets_off = before.step == 0 && s.volume_sets_off();
  if (sets_off && !before.trial) return {};
  const State<Dim>& known = sets_off ? *before.trial : before;
  const Room<Dim> room = span.open ? Room<Dim>(*span.open, *known.open) : Room<Dim>();
  const double length = span.until - span.from;
  const PlacedSources<Dim> sources(s, known, span.from);
  const CellValues brought = brought_by_feeds(s.domain, sources.feeds(), FedLiquid<Dim>(known), span.from, span.until);
  const LedgerRules<Dim> ledger(s.divergence(), room, next.room());
  const std::optional<FaceField<Dim>> through = flow_through_faces(s.domain, room, before.gap_flow, u);
  const VolumeCarriage<Dim> carriage{s.perturbation.surface_advection * length, span.level_set, before, ledger,
                                     brought};
  if (!sets_off) return carry_liquid(s.domain, u, through ? *through : u, carriage, next);
  FaceField<Dim> trial = known.exterior->volume_velocity(s.domain, s.fluids, known, length);
  FaceField<Dim> solved = flow_through_faces(s.domain, room, known.gap_flow, trial).value_or(trial);
  if (!s.fluids.has_gas() && (s.solids.bodies.empty() || any_moves(s.solids))) {
    const FaceField<Dim>& initial = through ? *through : u;
    const double part = share_of_trial(s.domain, ledger, next.liquid, brought, length, initial, solved);
    blend(s.domain.layout, u, part, trial), blend(s.domain.layout, initial, part, solved);
  }
  return carry_liquid(s.domain, trial, solved, carriage, next);
}

// Volumes of cells over a span along u, among solids at distance psi (m) from then on. Returns what fails, or nothing.
// `by_sources`: becomes the share of each cell that sources brought, if any are open.
template <int Dim>
std::string move_volumes(const Setup<Dim>& s, const VolumeSpan<Dim>& span, const FaceField<Dim>& u,
                         const NodeField<Dim>& psi, State<Dim>& next, std::optional<CellField<Dim>>& by_sources) {
  if (!s.tracks_volume()) return {};
  std::optional<FaceField<Dim>> of_both;
  if (s.fluids.has_gas())
    of_both = span.leading.exterior->volume_velocity(s.domain, s.fluids, span.leading, span.until - span.from);
  std::string fault = carry_volumes(s, span, of_both ? *of_both : u, next);
  Brought<Dim> brought = add_source_shares(s.domain, PlacedSources<Dim>(s, next, span.until).openings(), psi,
                                           span.leading.now->u, span.from, span.until, next.liquid);
  next.expected_volume += brought.volume;
  next.work.sides += s.fluids.density() * brought.kinetic;
  by_sources = std::move(brought.share);
  return fault;
}

// Volumes of cells from their last time to that of the solve.
template <int Dim>
std::string move_volumes_to_solve(const Setup<Dim>& s, const State<Dim>& before, const FaceField<Dim>& u,
                                  const StepTimes& times, Moved<Dim>& moved) {
  const CellField<Dim>& level_set = before.liquid_phi.empty() ? before.phi : before.liquid_phi;
  const VolumeSpan<Dim> span{before, times.start - before.volume_lag, times.start + times.lead, before.open.get(),
                             level_set};
  return move_volumes(s, span, u, moved.geometry.psi, moved.state, moved.brought);
}

// Volumes of cells from the solve to the end of a step whose second half is made with the velocity before it, u: the
// next step's flow would carry them along another way than level set and solids.
template <int Dim>
std::string move_volumes_to_end(const Setup<Dim>& s, const State<Dim>& before, const FaceField<Dim>& u,
                                const StepTimes& times, const StepGeometry<Dim>& at_end, State<Dim>& next) {
  const std::shared_ptr<const OpenParts<Dim>> at_solve = next.open;
  const CellField<Dim> level_set = std::move(next.liquid_phi);
  if (s.room_changes()) next.open = room_beside(s.domain, at_end.psi, at_solve->faces, next.separation);
  next.volume_lag = 0;
  std::optional<CellField<Dim>> by_sources;
  std::string fault = move_volumes(s, {before, times.start + times.lead, next.time, at_solve.get(), level_set}, u,
                                   at_end.psi, next, by_sources);
  keep_level_of_volumes(s.domain, at_end.psi, s.divergence(), next);
  return fault;
}

template <int Dim>
void carry_surface(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, Phases& phases,
                   Moved<Dim>& moved) {
  const PhaseFault fault = phases.enter("transport");
  const auto timed = phases.timers.measure("surface");
  FaceField<Dim> u = s.fluids.has_prescribed_flow()
                         ? prescribed_flow(s.domain, s.fluids, before, times.start + 0.5 * times.dt)
                         : before.exterior->surface_velocity(s.domain, s.fluids, before);
  CellField<Dim>& phi = moved.state.phi;
  const CellField<Dim, char>& closed = moved.closed.emplace(closed_cells(s.domain, s.solids, moved.geometry));
  const CellField<Dim, char> bent = cells_to_continue(s.domain, s.solids, moved.geometry, closed, phi, u, times.lead);
  // Redistancing after the transport covers ceil(cfl) + 1 cells: above cfl = 2 the half step before is too much.
  if (!times.leapfrog && may_leapfrog(s.features) && s.scene->time.cfl > 2)
    make_distance(s.domain, s.fluids, s.solids, s.scene->time, bent, phi);
  moved.failure = move_volumes_to_solve(s, before, u, times, moved);
  std::optional<CellField<Dim>> by_level_set =
      transport_and_book(s, before, std::move(u), times.start, times.lead, closed, moved.state);
  if (!s.tracks_volume()) moved.brought = std::move(by_level_set);
  make_distance(s.domain, s.fluids, s.solids, s.scene->time, bent, phi);
  const bool is_trial = before.step == 0 && s.volume_sets_off() && !before.trial;
  if (is_trial && (s.domain.sides.any_passes() || s.room_changes()))
    start_volume(s.domain, moved.geometry.psi, moved.state);
  inject(s.domain, fault, phi.data());
}

// phi before the step, with what sources bring and without what drains take on all sides of thin solids.
template <int Dim>
CellField<Dim> known_phi(const Domain<Dim>& domain, const Openings<Dim>& openings, const State<Dim>& before,
                         const StepTimes& times) {
  CellField<Dim> phi = before.phi;
  join_sources(domain, openings, times.start, times.start + times.lead, phi);
  fill_level_set_ghosts(domain.layout, domain.halo, phi);
  return phi;
}

// Keeps the liquid on its own side of thin solids.
template <int Dim>
void keep_sides(const Domain<Dim>& domain, const Solids<Dim>& solids, const Openings<Dim>& openings,
                const State<Dim>& before, const StepTimes& times, const StepGeometry<Dim>& geometry,
                CellField<Dim>& phi) {
  if (!has_thin(solids)) return;
  const std::vector<Placement> placed = place_bodies(before);
  if (openings.empty()) return keep_sides_apart(domain, solids, placed, before.phi, geometry, phi);
  keep_sides_apart(domain, solids, placed, known_phi(domain, openings, before, times), geometry, phi);
}

// Adds what feeds bring from t0 to t1 to the volume that is expected. `solved`: a state with the liquid in their
// shapes.
template <int Dim>
void book_feeds(const Setup<Dim>& s, const State<Dim>& solved, const StepGeometry<Dim>& geometry, double t0, double t1,
                State<Dim>& next) {
  if (s.feeds.empty()) return;
  const FedLiquid<Dim> liquid(s.domain.layout, solved, geometry.psi);
  next.expected_volume +=
      sum_of_cells(s.domain, brought_by_feeds(s.domain, PlacedSources<Dim>(s, solved, t0).feeds(), liquid, t0, t1));
}

template <int Dim>
void keep_volumes(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times, Phases& phases,
                  Moved<Dim>& moved) {
  const auto timed = phases.timers.measure("surface");
  State<Dim>& next = moved.state;
  const StepGeometry<Dim>& geometry = moved.geometry;
  if (s.tracks_volume()) {
    couple_liquid(s.domain, geometry.psi, {s.divergence(), next.room()}, next);
    next.exterior->follow(s.domain, geometry, before.now->u, times.looks_ahead() ? 0 : times.dt, next.phi);
    return next.exterior->weigh(s.domain, geometry, next.phi, next.liquid, next.room());
  }
  next.expected_volume += times.lead * net_inflow(s.domain, geometry, before.phi, before.now->u);
  book_feeds(s, before, geometry, times.start, times.start + times.lead, next);
  keep_sides_of_walls(s.domain, geometry, next.phi);
  if (s.features.has(Feature::sealed_cavities)) keep_sealed_full(s.domain, s.solids, before, next, geometry, next.phi);
  const PlacedSources<Dim> sources(s, next, times.start + times.lead);
  if (has_thin_elastic(s.solids)) keep_sides(s.domain, s.solids, sources.openings(), before, times, geometry, next.phi);
  const double uncounted =
      gap_volume(s.domain, s.fluids, before.separation) + volume_beyond(s.domain, s.solids, geometry, next.phi);
  const double expected = next.expected_volume + uncounted;
  next.exterior->follow(s.domain, geometry, before.now->u, times.looks_ahead() ? 0 : times.dt, next.phi);
  next.corrected_volume +=
      next.exterior->control_volume(s.domain, geometry, expected, largest_shift(s.domain), next.phi);
  keep_sides(s.domain, s.solids, sources.openings(), before, times, geometry, next.phi);
  next.exterior->follow(s.domain, geometry, before.now->u, 0, next.phi);
}

}  // namespace

template <int Dim>
Moved<Dim> move_surface_and_solids(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times,
                                   Phases& phases) {
  Moved<Dim> moved{shifted_levels(before, times), {}, {}};
  moved.failure = move_solids(s, before, times, moved.state);
  if (!moved.failure.empty()) return moved;
  moved.geometry = measure_geometry(s.domain, s.solids, s.scene->domain, moved.state, times, phases);
  moved.end = find_end(s.domain, s.fluids, s.solids, before, times, moved, phases);
  if (s.room_changes()) moved.state.open = room_at_solve(s.domain, moved);
  if (!times.looks_ahead()) carry_surface(s, before, times, phases, moved);
  if (moved.failure.empty()) moved.failure = land_before_solve(s, times, moved);
  keep_volumes(s, before, times, phases, moved);
  make_before_solve(s, before, times, moved);
  if (!s.feeds.empty())
    moved.fed = set_flux_of_feeds(s.domain, PlacedSources<Dim>(s, moved.state, times.start + times.lead).feeds(),
                                  FedLiquid<Dim>(s.domain.layout, moved.state, moved.geometry.psi),
                                  times.start + times.lead, times.dt, moved.geometry.faces);
  if (s.domain.sides.any_waves())
    absorb_waves<Dim>(s.domain, {before.phi, times.start}, {moved.state.phi, times.start + times.lead},
                      moved.state.time, moved.geometry);
  if (s.domain.sides.any_waves() && moved.state.exterior->flows())
    balance_gas_beside_waves(s.domain, moved.state.phi, moved.geometry);
  if (s.domain.sides.any_passes())
    find_entering(s.domain, before.exterior->joined_level(s.domain, s.fluids, before)->u, moved.geometry.faces);
  const auto timed = phases.timers.measure("surface");
  if (s.fluids.has_surface_tension())
    moved.tension = surface_tension(s.domain, s.fluids, s.solids, s.perturbation, moved.geometry, before.phi,
                                    moved.state.phi, times.looks_ahead() ? times.dt : times.lead, times.dt);
  return moved;
}

template <int Dim>
void move_second_half(const Setup<Dim>& s, const State<Dim>& before, const StepTimes& times,
                      const CellField<Dim, char>& closed, Phases& phases, Attempt<Dim>& solved) {
  const auto timed = phases.timers.measure("surface");
  State<Dim>& next = solved.state;
  const bool can = can_go_on(s.domain, s.solids, s.scene->time, next, times.dt);
  const State<Dim>& leading = can ? next : before;
  FaceField<Dim> u = leading.exterior->surface_velocity(s.domain, s.fluids, leading);
  if (!s.tracks_volume()) {
    next.expected_volume += times.lead * net_inflow(s.domain, solved.geometry, next.phi, leading.now->u);
    book_feeds(s, next, solved.geometry, times.start + times.lead, times.start + times.dt, next);
  }
  const FaceField<Dim> path = s.volume_lags() && !can ? u : FaceField<Dim>();
  (void)transport_and_book(s, next, std::move(u), times.start + times.lead, times.lead, closed, next);
  go_on(leading, times, next);
  show_solids(s, next);
  if (any_moves(s.solids)) solved.geometry = placed_at_end(s.solids, next, std::move(solved.geometry));
  if (s.volume_lags() && !can) solved.failure = move_volumes_to_end(s, before, path, times, solved.geometry, next);
  if (s.tracks_volume()) return;
  const double expected = next.expected_volume + gap_volume(s.domain, s.fluids, next.separation);
  next.corrected_volume +=
      next.exterior->control_volume(s.domain, solved.geometry, expected, largest_shift(s.domain), next.phi);
}

#define SEICHE_INSTANTIATE(D)                                                                                      \
  template Moved<D> move_surface_and_solids<D>(const Setup<D>&, const State<D>&, const StepTimes&, Phases&);       \
  template void move_second_half<D>(const Setup<D>&, const State<D>&, const StepTimes&, const CellField<D, char>&, \
                                    Phases&, Attempt<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
