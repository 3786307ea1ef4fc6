#pragma once
// Sources and drains where they are at one time: with the solids that they are attached to, or by motions of their own.
#include "coupling/state/setup.h"
#include "coupling/state/state.h"
#include "coupling/transport/sources.h"

namespace seiche {

template <int Dim>
class PlacedSources {
 public:
  // At time t (s). Solids that forces move are where the state has them. Keeps a reference to the setup.
  PlacedSources(const Setup<Dim>& setup, const State<Dim>& state, double t);

  const std::vector<Source<Dim>>& sources() const { return moved_ ? moved_->sources : setup_->sources; }
  const std::vector<Source<Dim>>& feeds() const { return moved_ ? moved_->feeds : setup_->feeds; }
  Openings<Dim> openings() const { return {sources(), moved_ ? moved_->drains : setup_->drains}; }

 private:
  struct Moved {
    std::vector<Source<Dim>> sources, drains, feeds;
  };

  const Setup<Dim>* setup_;
  std::optional<Moved> moved_;  // empty if none moves
};

}  // namespace seiche
