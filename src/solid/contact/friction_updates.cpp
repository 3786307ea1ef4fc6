#include "solid/contact/friction_updates.h"

#include <algorithm>
#include <map>

namespace seiche::contact {
namespace {

using PairKey = std::array<int, 5>;

PairKey key(const Candidate& p) {
  return {int(p.kind), p.points[0], p.points[1], p.points[2], p.points[3]};
}

// Points that no longer press, with a share of their bounds. Bounds below a thousandth of the largest one end.
template <int Dim>
void keep_fading(const std::map<PairKey, FrictionPoint<Dim>>& gone, double share, double largest,
                 std::vector<FrictionPoint<Dim>>& points) {
  for (const auto& [pair, f] : gone) {
    if (share * f.bound <= 1e-3 * largest) continue;
    points.push_back(f);
    points.back().bound *= share;
  }
}

}  // namespace

template <int Dim>
void update_friction(const Scene<Dim>& scene, const Placement<Dim>& at, const std::vector<Candidate>& pairs,
                     const Weights& weights, double taken, std::vector<FrictionPoint<Dim>>& points) {
  std::map<PairKey, FrictionPoint<Dim>> known;
  for (const FrictionPoint<Dim>& f : points) known.emplace(key(f.pair), f);
  points = friction_points<Dim>(scene, at, pairs, weights);
  double largest = 0;
  for (FrictionPoint<Dim>& f : points) {
    largest = std::max(largest, f.bound);
    f.bound *= taken;
    const auto before = known.find(key(f.pair));
    if (before == known.end()) continue;
    const double bound = f.bound + (1 - taken) * before->second.bound;
    if (taken < 1)
      f = before->second;
    else
      f.direction = f.tangent.transpose() * (before->second.tangent * before->second.direction);
    f.bound = bound;
    known.erase(before);
  }
  keep_fading<Dim>(known, 1 - taken, largest, points);
}

template <int Dim>
void turn_friction(const Velocities<Dim>& from, const Velocities<Dim>& to, double creep_speed,
                   std::vector<FrictionPoint<Dim>>& points) {
  for (FrictionPoint<Dim>& f : points) {
    const Eigen::Matrix<double, Dim - 1, 1> u = slip<Dim>(f, from);
    f.direction = next_direction<Dim>(f, u, slip<Dim>(f, to) - u, creep_speed);
  }
}

#define SEICHE_INSTANTIATE(Dim)                                                                               \
  template void update_friction<Dim>(const Scene<Dim>&, const Placement<Dim>&, const std::vector<Candidate>&, \
                                     const Weights&, double, std::vector<FrictionPoint<Dim>>&);               \
  template void turn_friction<Dim>(const Velocities<Dim>&, const Velocities<Dim>&, double,                    \
                                   std::vector<FrictionPoint<Dim>>&);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace seiche::contact
