#pragma once
// Friction points from update to update of the normal forces.
#include <array>
#include <map>

#include "solid/contact/system.h"

namespace seiche::contact {

// Updates after which the bounds of friction are damped: bodies may press in turns, for ever. Points are kept from then
// on, since they may leap to and fro along edges that are nearly parallel.
constexpr int damped_from = 8;
// Successive updates at the least share (1/32) after which the iteration counts as cyclic: more of them settle nothing.
constexpr int stuck_after = 5;

// Share of a change that a fixed-point iteration b + s (G(b) - b) takes, by Aitken's rule for vectors (Irons, Tuck
// 1969).
class Relaxation {
 public:
  using Key = std::array<int, 5>;
  using Changes = std::map<Key, double>;  // G(b) - b; entries that are left out are zero
  void restart() { before_.clear(); }
  // Share of the present changes, from the last ones and their share.
  double next(const Changes& now);

 private:
  Changes before_;
  double share_ = 1, most_ = 1;
};

// Bounds of friction and their updates, a fixed-point iteration: bounds b (N) give velocities, which give normal forces
// and with them G(b). From `damped_from` on updates are relaxed.
template <int Dim>
class FrictionUpdates {
 public:
  // Takes present normal forces and contact points. Pairs that rubbed before keep the directions of their forces. A
  // damped update keeps the points of those pairs as well.
  void update(const Scene<Dim>& scene, const Placement<Dim>& at, const std::vector<Candidate>& pairs,
              const Weights& weights);
  // Takes the directions of the forces along with Newton's step between the two velocities.
  void turn(const Velocities<Dim>& from, const Velocities<Dim>& to, double creep_speed);
  // Counts updates anew. The points stay.
  void restart();

  const std::vector<FrictionPoint<Dim>>& points() const { return points_; }
  // Share of the last change that was taken.
  double share() const { return share_; }
  // True if the last updates took no more than the least share: further ones would not settle the bounds.
  bool go_round() const { return stuck_ >= stuck_after; }

 private:
  using Known = std::map<Relaxation::Key, FrictionPoint<Dim>>;
  void take(const Known& known, bool damped);
  void fade(const Known& known, double largest);

  std::vector<FrictionPoint<Dim>> points_;
  Relaxation relaxation_;
  int count_ = 0, stuck_ = 0;
  double share_ = 1;
};

}  // namespace seiche::contact
