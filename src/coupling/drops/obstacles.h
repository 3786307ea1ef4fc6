#pragma once
// Solids and sides of the domain, as drops meet them.
#include <map>
#include <memory>

#include "coupling/geometry/placed_solid.h"
#include "coupling/state/drops.h"
#include "fluid/boundary/domain.h"

namespace seiche {

template <int Dim>
class Obstacles {
 public:
  // `placed`: the bodies of `geometry` with their velocities. Keeps references to all else. psi must be valid in the
  // halo.
  Obstacles(const Domain<Dim>& domain, const std::vector<Body<Dim>>& bodies, const StepGeometry<Dim>& geometry,
            std::vector<Placement> placed);

  // True if x is beyond a side that lets liquid out.
  bool has_left(const Vec<Dim>& x) const;
  // Brings a drop back through periodic sides, inside closed ones and out of solids: it touches what it reached into.
  // The normal part of its velocity against them is lost.
  void keep_out(Drop<Dim>& drop) const;
  // True if a drop touches a solid or a closed side.
  bool touches(const Drop<Dim>& drop) const;

 private:
  double contact_distance(double volume) const;
  void keep_within_sides(Drop<Dim>& drop) const;
  void find_room(Drop<Dim>& drop) const;
  double distance(const Vec<Dim>& x) const;
  Vec<Dim> normal(const Vec<Dim>& x) const;
  Vec<Dim> wall_velocity(const Vec<Dim>& x) const;

  const Domain<Dim>& domain_;
  const std::vector<Body<Dim>>& bodies_;
  const StepGeometry<Dim>& geometry_;
  std::vector<Placement> placed_;
  mutable std::map<int, std::unique_ptr<PlacedSolid<Dim>>> met_;  // bodies that drops met, placed
};

}  // namespace seiche
