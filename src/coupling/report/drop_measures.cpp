#include "coupling/report/drop_measures.h"

namespace seiche {

template <int Dim>
void measure_drops(const Domain<Dim>& domain, const Fluids& fluids, const State<Dim>& state, StepStats& stats) {
  stats.volume_left_out = state.drops.left_out;
  const Vec3 g = fluids.gravity.at(state.time);
  std::array<double, 7> sums{};  // drops, volume, kinetic and potential energy, momentum
  for (const Drop<Dim>& d : state.drops.list) {
    const double mass = fluids.density() * d.volume;
    sums[0] += 1;
    sums[1] += d.volume;
    sums[2] += 0.5 * mass * d.velocity.squaredNorm();
    sums[3] -= mass * truncate<Dim>(g).dot(d.place);
    for (int a = 0; a < Dim; ++a) sums[std::size_t(4 + a)] += mass * d.velocity[a];
  }
  domain.ranks.global_sum(sums);
  stats.drops = std::int64_t(sums[0]);
  stats.volume_drops = sums[1];
  stats.kinetic_energy += sums[2];
  stats.potential_energy += sums[3];
  for (int a = 0; a < 3; ++a) stats.momentum[a] += sums[std::size_t(4 + a)];
}

template <int Dim>
std::optional<std::vector<DropPoint>> drop_points(const Setup<Dim>& setup, const State<Dim>& state) {
  if (!setup.volume_meets_void()) return {};
  std::vector<DropPoint> points;
  for (const Drop<Dim>& d : state.drops.list)
    points.push_back({extend<Dim>(d.place), extend<Dim>(d.velocity), radius_of_drop<Dim>(d.volume), d.id});
  return points;
}

#define SEICHE_INSTANTIATE(D)                                                                   \
  template void measure_drops<D>(const Domain<D>&, const Fluids&, const State<D>&, StepStats&); \
  template std::optional<std::vector<DropPoint>> drop_points<D>(const Setup<D>&, const State<D>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)

}  // namespace seiche
