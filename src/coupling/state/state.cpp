#include "coupling/state/state.h"

#include "grid/domain_faces.h"
#include "grid/loops.h"

namespace seiche {
namespace {

// Inflow moves the surface in the air before it, too.
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

template <int Dim>
double speed_at(const TimeLevel<Dim>& level, int axis, Site f) {
  return level.valid.at(axis, f) ? std::abs(level.u.at(axis, f)) : 0.0;
}

}  // namespace

template <int Dim>
double fastest_component(const Domain<Dim>& domain, const State<Dim>& state) {
  double fastest = 0;
  for (int a = 0; a < Dim; ++a)
    fastest =
        std::max(fastest, local_max(domain.layout, domain.layout.faces(a), 0.0, [&](Site f) {
                   return std::max(speed_at(*state.now, a, f), state.gas.now ? speed_at(*state.gas.now, a, f) : 0.0);
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

#define SEICHE_INSTANTIATE(D)                                       \
  template std::vector<Placement> place_bodies<D>(const State<D>&); \
  template double fastest_component<D>(const Domain<D>&, const State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
