#include "solid/contact/path.h"

#include <algorithm>
#include <cmath>

namespace seiche {
namespace contact {
namespace {

// Share of its gap that a pair keeps. A pair from beyond the reach may come as near as half the reach.
constexpr double kept_share = 0.2, kept_of_reach = 0.5;
// Paths are taken as straight within rotations of this angle (rad). The error is at most 3 % of a body's radius,
// inwards.
constexpr double turn_limit = 0.5;
constexpr double retreat = 0.99;  // safety factor on the share, so that round-off does not cause another attempt
constexpr int advance_limit = 200, retreat_limit = 60;

// Least time at which the gap of any two points along the normal has shrunk to `floor`; 1 if none does.
template <int Dim>
double advance(PairKind kind, const PairPoints<Dim>& x, const PairPoints<Dim>& rate, const Vec<Dim>& normal,
               double floor) {
  double time = 1;
  const int count = points_of(kind, Dim), first = points_of_first(kind);
  for (int i = 0; i < first; ++i)
    for (int j = first; j < count; ++j) {
      const double gap = normal.dot(x[i] - x[j]), closing = -normal.dot(rate[i] - rate[j]);
      if (closing > 0) time = std::min(time, std::max(gap - floor, 0.) / closing);
    }
  return time;
}

template <int Dim>
Velocities<Dim> between(const Velocities<Dim>& from, const Velocities<Dim>& to, double share) {
  Velocities<Dim> r = from;
  for (size_t b = 0; b < r.twists.size(); ++b) r.twists[b] += share * (to.twists[b] - from.twists[b]);
  for (size_t p = 0; p < r.points.size(); ++p) r.points[p] += share * (to.points[p] - from.points[p]);
  return r;
}

template <int Dim>
int legs_of(const Interval<Dim>& interval, const Twists<Dim>& from, const Twists<Dim>& to) {
  double turn = 0;
  for (size_t b = 0; b < from.size(); ++b)
    turn = std::max(turn, (to[b] - from[b]).template tail<turn_size<Dim>>().norm() * interval.horizon);
  return std::max(1, static_cast<int>(std::ceil(std::min(turn / turn_limit, 1e4))));
}

template <int Dim>
double least_share(const typename ContactScene<Dim>::Data& scene, const std::vector<Candidate>& pairs,
                   const Points<Dim>& from, const Points<Dim>& to, double reach) {
  double share = 1;
  for (const Candidate& pair : pairs)
    share = std::min(share, pair_share<Dim>(scene, pair, gather<Dim>(pair, from), gather<Dim>(pair, to), reach));
  return share;
}

// One attempt. The share refers to straight paths and is valid only if it is 1, since a rotating body leaves them.
template <int Dim>
Walk<Dim> attempt(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval,
                  const Placement<Dim>& from, const Velocities<Dim>& target, double reach) {
  const int legs = legs_of<Dim>(interval, from.velocities.twists, target.twists);
  Walk<Dim> r{0, from, {}};
  for (int leg = 1; leg <= legs; ++leg) {
    Placement<Dim> next =
        place<Dim>(scene, interval, leg == legs ? target : between<Dim>(from.velocities, target, double(leg) / legs));
    r.near = find_candidates<Dim>(scene, r.end.points, next.points, reach);
    const double share = least_share<Dim>(scene, r.near, r.end.points, next.points, reach);
    r.share = (leg - 1 + share) / legs;
    if (share < 1) return r;
    r.end = std::move(next);
  }
  r.share = 1;
  return r;
}

}  // namespace

template <int Dim>
double pair_share(const typename ContactScene<Dim>::Data& scene, const Candidate& pair, const PairPoints<Dim>& from,
                  const PairPoints<Dim>& to, double scene_reach) {
  const double reach = pair.reach(scene_reach);
  PairPoints<Dim> x = from, rate;
  for (int i = 0; i < 4; ++i) rate[i] = to[i] - from[i];
  Separation<Dim> apart = separate<Dim>(scene, pair, x);
  if (apart.distance <= 0) return 0;
  const double floor = reach > 0 && apart.distance > reach ? kept_of_reach * reach : kept_share * apart.distance;
  if (pair.kind == PairKind::point_wall) {
    const double closing = -rate[0].dot(apart.normal);
    return closing <= apart.distance - floor ? 1 : (apart.distance - floor) / closing;
  }
  double time = 0;
  for (int i = 0; i < advance_limit; ++i) {
    time += advance<Dim>(pair.kind, x, rate, apart.normal, floor);
    if (time >= 1) return 1;
    for (int k = 0; k < 4; ++k) x[k] = from[k] + time * rate[k];
    apart = separate<Dim>(scene, pair, x);
    if (apart.distance <= 1.2 * floor) break;
  }
  return time;
}

template <int Dim>
Walk<Dim> walk(const typename ContactScene<Dim>::Data& scene, const Interval<Dim>& interval, const Placement<Dim>& from,
               const Velocities<Dim>& target, double reach) {
  double share = 1;
  for (int i = 0; i < retreat_limit; ++i) {
    const Velocities<Dim> goal = share == 1 ? target : between<Dim>(from.velocities, target, share);
    Walk<Dim> r = attempt<Dim>(scene, interval, from, goal, reach);
    if (r.share == 1) {
      r.share = share;
      return r;
    }
    share *= retreat * r.share;
  }
  return {0, from, find_candidates<Dim>(scene, from.points, from.points, reach)};
}

#define SEICHE_INSTANTIATE(Dim)                                                                             \
  template double pair_share<Dim>(const ContactScene<Dim>::Data&, const Candidate&, const PairPoints<Dim>&, \
                                  const PairPoints<Dim>&, double);                                          \
  template Walk<Dim> walk<Dim>(const ContactScene<Dim>::Data&, const Interval<Dim>&, const Placement<Dim>&, \
                               const Velocities<Dim>&, double);
SEICHE_INSTANTIATE(2)
SEICHE_INSTANTIATE(3)
#undef SEICHE_INSTANTIATE

}  // namespace contact

// Zero reach: each pair keeps its share of the gap.
template <int Dim>
double largest_safe_fraction(const ContactScene<Dim>& scene, const std::vector<ContactMotion>& motions, double horizon,
                             const Eigen::VectorXd& velocity) {
  const auto interval = contact::make_interval<Dim>(scene.data(), motions, horizon);
  const auto start = contact::place<Dim>(
      scene.data(), interval,
      contact::all_velocities<Dim>(scene.data(), interval, Eigen::VectorXd::Zero(velocity.size()), 0));
  const auto target = contact::all_velocities<Dim>(scene.data(), interval, velocity, 1);
  return contact::walk<Dim>(scene.data(), interval, start, target, 0).share;
}

template double largest_safe_fraction<2>(const ContactScene<2>&, const std::vector<ContactMotion>&, double,
                                         const Eigen::VectorXd&);
template double largest_safe_fraction<3>(const ContactScene<3>&, const std::vector<ContactMotion>&, double,
                                         const Eigen::VectorXd&);

}  // namespace seiche
