#pragma once
// A thin solid where it stands at one time: what lies on which side of it.
#include <optional>

#include "levelset/surface_distance.h"
#include "solid/rigid/state.h"

namespace seiche {

template <int Dim>
class PlacedSolid {
 public:
  // Keeps references to layout and body.
  PlacedSolid(const Layout<Dim>& layout, const Body<Dim>& body, const Placement& placed);
  PlacedSolid(const PlacedSolid&) = delete;

  // Of a thin solid: whether the segment from x to y, at most two cells along each axis, meets its surface.
  bool lies_between(const Vec<Dim>& x, const Vec<Dim>& y) const;
  // The share of the way from x to y, at most two cells along each axis, after which an elastic solid's surface comes;
  // 2 where none does.
  double first_crossing(const Vec<Dim>& x, const Vec<Dim>& y) const { return surface_->first_crossing(x, y); }
  // The normal of an elastic solid's facet that is nearest.
  Vec<Dim> normal_near(const Vec<Dim>& x) const { return surface_->normal_near(x); }
  // Signed, m; of an elastic solid as SurfaceDistance has it.
  double distance(const Vec<Dim>& x) const;
  // Where a point beside the solid was in another placement: carried along with the nearest point of an elastic one.
  Vec<Dim> carried_to(const PlacedSolid& other, const Vec<Dim>& x) const;

 private:
  const Body<Dim>& body_;
  Pose pose_;
  std::vector<Vec<Dim>> points_;  // of an elastic solid's surface
  std::optional<SurfaceDistance<Dim>> surface_;
};

}  // namespace seiche
