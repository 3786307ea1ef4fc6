#include "coupling/state/state.h"

#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Largest |u_a| on this rank's inflow faces, m/s, wet or dry: inflow also moves the surface in the air in front of it.
template <int Dim>
double fastest_inflow(const Domain<Dim>& domain, const TimeLevel<Dim>& level) {
  double fastest = 0;
  for (int a = 0; a < Dim; ++a)
    for (int side = 0; side < 2; ++side) {
      if (domain.sides.type(a, side) != SideType::inflow) continue;
      const Box<Dim> box = faces_of_side(domain.layout, a, side);
      fastest =
          std::max(fastest, local_max(domain.layout, box, 0.0, [&](Site f) { return std::abs(level.u.at(a, f)); }));
    }
  return fastest;
}

// Largest |u| of the owned valid faces; 0 if there is no such level. Local.
template <int Dim>
double fastest_of(const Layout<Dim>& layout, const std::shared_ptr<const TimeLevel<Dim>>& level) {
  double fastest = 0;
  for (int a = 0; level && a < Dim; ++a)
    fastest = local_max_of_possible(
        layout, layout.faces(a), fastest, [&](Site f) { return any_marked(level->valid[a].data() + f); },
        [&](Site f) { return level->valid.at(a, f) ? std::abs(level->u.at(a, f)) : 0.0; });
  return fastest;
}

}  // namespace

template <int Dim>
double fastest_component(const Domain<Dim>& domain, const State<Dim>& state) {
  const double fastest =
      std::max(fastest_of(domain.layout, state.now), fastest_of(domain.layout, state.exterior->flow.now));
  return domain.ranks.global_max(std::max(fastest, fastest_inflow(domain, *state.now)));
}

template <int Dim>
std::vector<Placement> place_bodies(const State<Dim>& state) {
  std::vector<Placement> placed;
  for (std::size_t k = 0; k < state.solids.size(); ++k)
    placed.push_back(state.solids[k].place(state.time - state.dt_now, state.time, state.time));
  return placed;
}

template <int Dim>
std::vector<Placement> place_moving_bodies(const State<Dim>& state) {
  std::vector<Placement> placed = place_bodies(state);
  for (std::size_t k = 0; k < placed.size(); ++k) state.solids[k].set_velocity(placed[k]);
  return placed;
}

#define SEICHE_INSTANTIATE(D)                                              \
  template std::vector<Placement> place_bodies<D>(const State<D>&);        \
  template std::vector<Placement> place_moving_bodies<D>(const State<D>&); \
  template double fastest_component<D>(const Domain<D>&, const State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
