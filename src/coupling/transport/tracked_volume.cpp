#include "coupling/transport/tracked_volume.h"

#include <fmt/format.h>

#include <optional>

#include "coupling/transport/drifting.h"
#include "fluid/boundary/domain.h"
#include "fluid/boundary/inflow.h"
#include "fluid/volume/level_set_coupling.h"
#include "fluid/volume/own_side.h"
#include "fluid/volume/spill.h"
#include "fluid/volume/surface_difference.h"
#include "fluid/volume/volume_transport.h"
#include "grid/loops.h"

namespace seiche {

template <int Dim>
void start_volume(const Domain<Dim>& domain, const NodeField<Dim>& psi, State<Dim>& state) {
  state.liquid = CellField<Dim>(domain.layout);
  const Room<Dim> room = state.room();
  for_each_site(domain.layout, domain.layout.cells(),
                [&](Site c) { state.liquid[c] = liquid_share(domain.layout, room, state.phi, psi, c); });
  fill_share_ghosts(domain.layout, domain.halo, state.liquid);
  state.expected_volume = tracked_volume(domain, state);
}

template <int Dim>
std::optional<FaceField<Dim>> flow_through_faces(const Domain<Dim>& domain, const Room<Dim>& room,
                                                 const GapFlow<Dim>& solved, const FaceField<Dim>& u) {
  if (room.is_whole()) return {};
  FaceField<Dim> through = u;
  for (int a = 0; a < Dim; ++a)
    for_each_site(domain.layout, domain.layout.faces(a), [&](Site f) {
      if (solved.u.at(a, f) != 0) through.at(a, f) = solved.u.at(a, f);
    });
  domain.halo.fill_ghosts(through);
  return through;
}

namespace {

// Volume that passes the faces of a cell inwards in `span`, in cells.
template <int Dim>
double passed_in(const Layout<Dim>& layout, const Room<Dim>& room, const FaceField<Dim>& u, double span, Site c) {
  double net = 0;
  for (int a = 0; a < Dim; ++a) {
    const Site high = c + layout.stride(a);
    net += room.through(a, c) * u.at(a, c) - room.through(a, high) * u.at(a, high);
  }
  return span / layout.h() * net;
}

}  // namespace

// m = K + dt/h sum +- w u + b - K' is what a full cell would have too much of, b what feeds bring. The part p of the
// trial leaves the least sum of squares of m0 + p (m1 - m0) over full cells, m0 and m1 those of both flows. It is 0
// where both fit, to the solver's tolerance.
template <int Dim>
double share_of_trial(const Domain<Dim>& domain, const Ledger<Dim>& ledger, const CellField<Dim>& share,
                      const CellValues& brought, double span, const FaceField<Dim>& initial,
                      const FaceField<Dim>& trial) {
  constexpr double least = 1e-6, lacking = 0.05, certain = 0.99;
  const Layout<Dim>& l = domain.layout;
  CellField<Dim> fed(l);
  for (const auto& [c, volume] : brought) fed[c] += volume / l.geometry().cell_volume();
  std::array<double, 3> sums{};  // m0 (m0 - m1), (m1 - m0)^2, squares of the difference of ways, in cells
  for_each_index_in_order(l, l.cells(), [&](Site c, const IVec<Dim>&) {
    const double room = ledger.room.of(c);
    if (room == 0 || share[c] < room - lacking) return;
    const double in = passed_in(l, ledger.room, initial, span, c), m0 = room + in + fed[c] - ledger.after.of(c),
                 change = passed_in(l, ledger.room, trial, span, c) - in;
    sums[0] -= m0 * change;
    sums[1] += change * change;
    for (int a = 0; a < Dim; ++a) sums[2] += std::pow(span / l.h() * (trial.at(a, c) - initial.at(a, c)), 2);
  });
  domain.ranks.global_sum(sums);
  if (sums[1] <= least * sums[2]) return 0;
  const double part = sums[0] / sums[1];
  return part > certain ? 1 : std::max(part, 0.0);
}

namespace {

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
std::string carry_liquid(const Domain<Dim>& domain, const FaceField<Dim>& u, const FaceField<Dim>& through,
                         const VolumeCarriage<Dim>& carriage, State<Dim>& state) {
  const State<Dim>& leading = carriage.leading;
  const std::optional<FaceField<Dim>> path = path_beyond_sides(domain, leading, carriage.ledger.divergence, u);
  VolumeFlow<Dim> flow{path ? *path : u, through, domain.sides.any_inflow(),
                       cells_beyond_inflows(domain.layout, domain.sides, leading.time)};
  for (const auto& [c, volume] : carriage.brought)
    flow.brought.emplace_back(c, volume / domain.layout.geometry().cell_volume());
  const VolumeStep step = carry_volume<Dim>(domain.layout, domain.halo, domain.ranks, flow, carriage.span,
                                            carriage.level_set, carriage.ledger, state.liquid);
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
void keep_level_of_volumes(const Domain<Dim>& domain, const NodeField<Dim>& psi, Divergence divergence,
                           State<Dim>& state) {
  state.liquid_phi = state.phi;
  if (state.liquid_beyond.empty()) return;
  Difference<Dim> difference(domain.layout, psi, state.phi, {divergence, state.room()}, state.liquid);
  state.liquid_beyond = std::move(difference.missing);
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

namespace {

// Liquid that cells at the surface have beyond the level set at their time.
template <int Dim>
struct BeyondLevelSet {
  std::array<double, std::size_t(2 * Dim + 1)> sums{};  // times places and velocities, and half their squares, cells

  Vec<Dim> moment() const { return Eigen::Map<const Vec<Dim>>(sums.data()); }
  double flow(int axis) const { return sums[std::size_t(Dim + axis)]; }
  double half_square() const { return sums.back(); }
  void operator+=(const BeyondLevelSet& other) {
    for (std::size_t n = 0; n < sums.size(); ++n) sums[n] += other.sums[n];
  }
};

// Collective.
template <int Dim>
BeyondLevelSet<Dim> beyond_level_set(const Domain<Dim>& domain, const State<Dim>& state) {
  constexpr double near = 1.6;  // cells from the surface within which a cell may be mixed
  const Layout<Dim>& l = domain.layout;
  const auto may_differ = [&](Site c) { return !all_zero(state.liquid_beyond.data() + c); };
  BeyondLevelSet<Dim> own = local_sum_of_possible(l, l.cells(), may_differ, [&](Site c) {
    BeyondLevelSet<Dim> r;
    const double beyond = state.liquid_beyond[c];
    if (beyond == 0 || state.phi[c] >= near * l.h()) return r;
    const Vec<Dim> x = l.position(l.index(c), cell_offset<Dim>());
    for (int a = 0; a < Dim; ++a) {
      const double low = state.now->u.at(a, c), high = state.now->u.at(a, c + l.stride(a));
      r.sums[std::size_t(a)] = beyond * x[a];
      r.sums[std::size_t(Dim + a)] = 0.5 * beyond * (low + high);
      r.sums.back() += 0.25 * beyond * (low * low + high * high);
    }
    return r;
  });
  domain.ranks.global_sum(own.sums);
  return own;
}

}  // namespace

template <int Dim>
void measure_tracked(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats) {
  const double tracked = tracked_volume(domain, state);
  if (fluids.has_gas()) stats.gas_volume += stats.liquid_volume - tracked;
  stats.liquid_volume = tracked;
  stats.volume_drifting = drifting_volume(domain, state);
  stats.volume_spilled = state.spilled_volume;
  if (fluids.has_gas() || fluids.has_prescribed_flow()) return;
  const BeyondLevelSet<Dim> beyond = beyond_level_set(domain, state);
  const double mass = fluids.density() * domain.layout.geometry().cell_volume();
  stats.potential_energy -= mass * truncate<Dim>(fluids.gravity.at(state.time)).dot(beyond.moment());
  stats.kinetic_energy = std::max(0.0, stats.kinetic_energy + mass * beyond.half_square());
  for (int a = 0; a < Dim; ++a) stats.momentum[a] += mass * beyond.flow(a);
}

#define SEICHE_INSTANTIATE(D)                                                                                     \
  template void start_volume<D>(const Domain<D>&, const NodeField<D>&, State<D>&);                                \
  template std::optional<FaceField<D>> flow_through_faces<D>(const Domain<D>&, const Room<D>&, const GapFlow<D>&, \
                                                             const FaceField<D>&);                                \
  template double share_of_trial<D>(const Domain<D>&, const Ledger<D>&, const CellField<D>&, const CellValues&,   \
                                    double, const FaceField<D>&, const FaceField<D>&);                            \
  template std::string carry_liquid<D>(const Domain<D>&, const FaceField<D>&, const FaceField<D>&,                \
                                       const VolumeCarriage<D>&, State<D>&);                                      \
  template void couple_liquid<D>(const Domain<D>&, const NodeField<D>&, const Ledger<D>&, State<D>&);             \
  template void keep_level_of_volumes<D>(const Domain<D>&, const NodeField<D>&, Divergence, State<D>&);           \
  template std::string fault_of_volume<D>(const Domain<D>&, const State<D>&, const State<D>&);                    \
  template double tracked_volume<D>(const Domain<D>&, const State<D>&);                                           \
  template void measure_tracked<D>(const Domain<D>&, const Fluids&, const State<D>&, StepStats&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
