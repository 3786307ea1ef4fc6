#include "solid/contact/friction_updates.h"

#include <algorithm>
#include <set>

namespace seiche::contact {
namespace {

constexpr double first_taken = 0.5, least_taken = 1.0 / 32;
constexpr double faded = 1e-3;  // of the largest bound: smaller ones of pairs that no longer press end

Relaxation::Key key(const Candidate& p) {
  return {int(p.kind), p.points[0], p.points[1], p.points[2], p.points[3]};
}

}  // namespace

// s' = s r.(r - r')/|r - r'|^2 for the changes r and r', the zero of the line through the two; s/2 if that lies behind.
// The most that is taken is halved if changes grow. It doubles if they shrink without a turn.
double Relaxation::next(const Changes& now) {
  double old = 0, both = 0, present = 0;  // r.r, r.r', r'.r'
  for (const auto& [pair, r] : before_) old += r * r;
  for (const auto& [pair, r] : now) {
    const auto before = before_.find(pair);
    present += r * r;
    if (before != before_.end()) both += before->second * r;
  }
  if (before_.empty())
    most_ = 1;
  else if (present > old)
    most_ = std::max(most_ / 2, least_taken);
  else if (both > 0)
    most_ = std::min(2 * most_, 1.0);
  const double wanted = both < old ? share_ * (old - both) / (old - 2 * both + present) : share_ / 2;
  share_ = before_.empty() ? first_taken : std::clamp(wanted, least_taken, most_);
  before_ = now;
  return share_;
}

template <int Dim>
void FrictionUpdates<Dim>::restart() {
  relaxation_.restart();
  count_ = stuck_ = 0;
}

template <int Dim>
void FrictionUpdates<Dim>::update(const Scene<Dim>& scene, const Placement<Dim>& at,
                                  const std::vector<Candidate>& pairs, const Weights& weights) {
  const bool damped = count_++ >= damped_from;
  Known known;
  for (const FrictionPoint<Dim>& f : points_) known.emplace(key(f.pair), f);
  points_ = friction_points<Dim>(scene, at, pairs, weights);
  Relaxation::Changes changes;
  double largest = 0;
  for (const FrictionPoint<Dim>& f : points_) {
    largest = std::max(largest, f.bound);
    changes[key(f.pair)] = f.bound;
  }
  for (const auto& [pair, f] : known) changes[pair] -= f.bound;
  share_ = damped ? relaxation_.next(changes) : 1;
  stuck_ = share_ <= least_taken ? stuck_ + 1 : 0;
  take(known, damped);
  fade(known, largest);
}

// Bounds b + s (G(b) - b) of the pairs that press.
template <int Dim>
void FrictionUpdates<Dim>::take(const Known& known, bool damped) {
  for (FrictionPoint<Dim>& f : points_) {
    const auto before = known.find(key(f.pair));
    const double used = before == known.end() ? 0 : before->second.bound;
    const double bound = used + share_ * (f.bound - used);
    if (before != known.end() && damped)
      f = before->second;
    else if (before != known.end())
      f.direction = f.tangent.transpose() * (before->second.tangent * before->second.direction);
    f.bound = bound;
  }
}

// Bounds (1 - s) b of the pairs that no longer press.
template <int Dim>
void FrictionUpdates<Dim>::fade(const Known& known, double largest) {
  std::set<Relaxation::Key> pressed;
  for (const FrictionPoint<Dim>& f : points_) pressed.insert(key(f.pair));
  for (auto [pair, f] : known) {
    f.bound *= 1 - share_;
    if (!pressed.contains(pair) && f.bound > faded * largest) points_.push_back(f);
  }
}

template <int Dim>
void FrictionUpdates<Dim>::turn(const Velocities<Dim>& from, const Velocities<Dim>& to, double creep_speed) {
  for (FrictionPoint<Dim>& f : points_) {
    const Eigen::Matrix<double, Dim - 1, 1> u = slip<Dim>(f, from);
    f.direction = next_direction<Dim>(f, u, slip<Dim>(f, to) - u, creep_speed);
  }
}

template class FrictionUpdates<2>;
template class FrictionUpdates<3>;

}  // namespace seiche::contact
