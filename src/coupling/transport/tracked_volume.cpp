#include "coupling/transport/tracked_volume.h"

#include <fmt/format.h>

#include <optional>

#include "coupling/transport/drifting.h"
#include "fluid/boundary/domain.h"
#include "fluid/boundary/inflow.h"
#include "fluid/volume/level_set_coupling.h"
#include "fluid/volume/spill.h"
#include "fluid/volume/volume_transport.h"
#include "grid/loops.h"
#include "levelset/fractions.h"

namespace seiche {

template <int Dim>
void start_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, State<Dim>& state) {
  state.liquid = CellField<Dim>(domain.layout);
  for_each_site(domain.layout, domain.layout.cells(),
                [&](Site c) { state.liquid[c] = liquid_share(domain.layout, state.phi, psi, c); });
  fill_share_ghosts(domain.layout, domain.halo, state.liquid);
  state.expected_volume = tracked_volume(domain, state);
}

namespace {

// u (m/s), with what the solve gave the faces that are hardly open. Collective.
template <int Dim>
FaceField<Dim> flow_through_faces(const Domain<Dim>& domain, const GapFlow<Dim>& solved, FaceField<Dim> u) {
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (solved.u.at(a, f) != 0) u.at(a, f) = solved.u.at(a, f);
    });
  domain.halo.fill_ghosts(u);
  return u;
}

// u continued beyond inflow sides for paths, as those of the level set, m/s. Empty if there are none, or the flow is
// prescribed: it is known there.
template <int Dim>
std::optional<FaceField<Dim>> path_beyond_sides(const Domain<Dim>& domain, const State<Dim>& before,
                                                Divergence divergence, const FaceField<Dim>& u) {
  if ((!domain.sides.any_inflow() && !domain.sides.any_waves()) || divergence == Divergence::swells) return {};
  FaceField<Dim> path = u;
  continue_beyond_inflows(domain.layout, domain.sides, before.time, path);
  let_air_follow(domain.layout, domain.sides, before.time, before.now->valid, path);
  return path;
}

// Volume in drifting cells (drifting.h), m^Dim. Collective.
template <int Dim>
double drifting_volume(const Domain<Dim>& domain, const State<Dim>& state) {
  const CellField<Dim>& phi = state.liquid_phi.empty() ? state.phi : state.liquid_phi;
  double cells = 0;
  for (const Site c : drifting_cells(domain, phi, state.liquid))
    if (domain.layout.cells().contains(domain.layout.index(c))) cells += state.liquid[c];
  return domain.ranks.global_sum(cells) * domain.layout.geometry().cell_volume();
}

}  // namespace

template <int Dim>
std::string carry_liquid(const Domain<Dim>& domain, const FaceField<Dim>& u, const GapFlow<Dim>& solved, double span,
                         const Ledger<Dim>& ledger, const CellValues& brought, const State<Dim>& before,
                         State<Dim>& state) {
  const CellField<Dim>& phi = before.liquid_phi.empty() ? before.phi : before.liquid_phi;
  const std::optional<FaceField<Dim>> through =
      ledger.room.is_whole() ? std::nullopt : std::optional(flow_through_faces(domain, solved, u));
  const std::optional<FaceField<Dim>> path = path_beyond_sides(domain, before, ledger.divergence, u);
  VolumeFlow<Dim> flow{path ? *path : u, through ? *through : u, domain.sides.any_inflow(),
                       cells_beyond_inflows(domain.layout, domain.sides, before.time)};
  for (const auto& [c, volume] : brought) flow.brought.emplace_back(c, volume / domain.layout.geometry().cell_volume());
  const VolumeStep step =
      carry_volume<Dim>(domain.layout, domain.halo, domain.ranks, flow, span, phi, ledger, state.liquid);
  state.expected_volume += (step.entered + step.swollen + step.fed) * domain.layout.geometry().cell_volume();
  state.spilled_volume += step.spill.moved * domain.layout.geometry().cell_volume();
  if (step.too_far == 0) return {};
  return fmt::format("{} paths of the liquid cross more than {} cells in a quarter of a step", step.too_far,
                     longest_path(domain.layout));
}

template <int Dim>
void couple_liquid(const Domain<Dim>& domain, const NodeField<Dim>& psi, const Ledger<Dim>& ledger, State<Dim>& state) {
  couple_level_set(domain.layout, domain.halo, domain.ranks, psi, ledger, state.phi, state.liquid);
}

template <int Dim>
std::string fault_of_volume(const Domain<Dim>& domain, const State<Dim>& before, const State<Dim>& next) {
  constexpr double rounding = 1e-11;
  const double was = tracked_volume(domain, before), is = tracked_volume(domain, next),
               entered = next.expected_volume - before.expected_volume;
  if (std::abs(is - was - entered) <= rounding * std::max(was + is, domain.layout.geometry().cell_volume())) return {};
  return fmt::format(
      "the volume of liquid changes by {:.6g} m^{} in a step, but {:.6g} came in or by the flow's divergence", is - was,
      Dim, entered);
}

template <int Dim>
double tracked_volume(const Domain<Dim>& domain, const State<Dim>& state) {
  const double cells =
      local_sum(domain.layout, domain.layout.cells(), [&](Site c, const IVec<Dim>&) { return state.liquid[c]; });
  double local = cells * domain.layout.geometry().cell_volume();
  for (const Drop<Dim>& d : state.drops.list) local += d.volume;
  return domain.ranks.global_sum(local);
}

template <int Dim>
void measure_tracked(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats) {
  const double tracked = tracked_volume(domain, state);
  if (fluids.has_gas()) stats.gas_volume += stats.liquid_volume - tracked;
  stats.liquid_volume = tracked;
  stats.volume_drifting = drifting_volume(domain, state);
  stats.volume_spilled = state.spilled_volume;
}

#define SEICHE_INSTANTIATE(D)                                                                            \
  template void start_volume<D>(const Domain<D>&, const NodeField<D>&, State<D>&);                       \
  template std::string carry_liquid<D>(const Domain<D>&, const FaceField<D>&, const GapFlow<D>&, double, \
                                       const Ledger<D>&, const CellValues&, const State<D>&, State<D>&); \
  template void couple_liquid<D>(const Domain<D>&, const NodeField<D>&, const Ledger<D>&, State<D>&);    \
  template std::string fault_of_volume<D>(const Domain<D>&, const State<D>&, const State<D>&);           \
  template double tracked_volume<D>(const Domain<D>&, const State<D>&);                                  \
  template void measure_tracked<D>(const Domain<D>&, const Fluids&, const State<D>&, StepStats&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
