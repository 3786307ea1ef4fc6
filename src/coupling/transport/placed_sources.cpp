#include "coupling/transport/placed_sources.h"

#include <algorithm>

namespace seiche {
namespace {

// Time over which prescribed velocities are differences, s.
constexpr double shortest_difference = 1e-6;

template <int Dim>
std::vector<Source<Dim>> placed(std::vector<Source<Dim>> sources, const State<Dim>& state, double t) {
  const double tau = std::max(shortest_difference, 1e-3 * state.dt_now);
  for (Source<Dim>& source : sources) {
    if (source.motion) {
      source.pose = source.motion->pose(t);
      source.twist = source.motion->twist(t, tau);
    } else if (source.solid >= 0) {
      Placement at = state.solids[std::size_t(source.solid)].place(t, t + tau, t);
      state.solids[std::size_t(source.solid)].set_velocity(at);
      source.pose = at.pose;
      source.twist = at.twist;
    }
  }
  return sources;
}

}  // namespace

template <int Dim>
PlacedSources<Dim>::PlacedSources(const Setup<Dim>& setup, const State<Dim>& state, double t) : setup_(&setup) {
  const auto moves = [](const Source<Dim>& source) { return source.moves(); };
  if (std::ranges::none_of(setup.sources, moves) && std::ranges::none_of(setup.drains, moves) &&
      std::ranges::none_of(setup.feeds, moves))
    return;
  moved_.emplace(Moved{placed(setup.sources, state, t), placed(setup.drains, state, t), placed(setup.feeds, state, t)});
}

template class PlacedSources<2>;
template class PlacedSources<3>;

}  // namespace seiche
