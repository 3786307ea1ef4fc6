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

// 0 if there is no such level.
template <int Dim>
double speed_at(const std::shared_ptr<const TimeLevel<Dim>>& level, int axis, Site f) {
  return level && level->valid.at(axis, f) ? std::abs(level->u.at(axis, f)) : 0.0;
}

}  // namespace

template <int Dim>
double fastest_component(const Domain<Dim>& domain, const State<Dim>& state) {
  double fastest = 0;
  for (int a = 0; a < Dim; ++a)
    fastest = std::max(fastest, local_max(domain.layout, domain.layout.faces(a), 0.0, [&](Site f) {
                         return std::max(speed_at(state.now, a, f), speed_at(state.exterior->flow.now, a, f));
                       }));
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
