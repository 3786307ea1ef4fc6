#include "coupling/geometry/placed_solid.h"

#include "geometry/mesh/segment_crossing.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

template <int Dim>
Vec<Dim> position(const SurfacePoint<Dim>& p, const std::vector<Vec<Dim>>& points) {
  Vec<Dim> x = Vec<Dim>::Zero();
  for (int i = 0; i < Dim; ++i) x += p.weights[i] * points[std::size_t(p.corners[i])];
  return x;
}

}  // namespace

template <int Dim>
PlacedSolid<Dim>::PlacedSolid(const Layout<Dim>& layout, const Body<Dim>& body, const Placement& placed)
    : body_(body), pose_(placed.pose) {
  if (!body.is_elastic()) return;
  points_ = surface_points(body.elastic(), placed.displacement);
  surface_.emplace(layout, body.elastic().surface.facets, points_);
}

template <int Dim>
bool PlacedSolid<Dim>::lies_between(const Vec<Dim>& x, const Vec<Dim>& y) const {
  return surface_ ? surface_->first_crossing(x, y) <= 1 + crossing_slack : body_.lies_between(pose_, x, y);
}

template <int Dim>
double PlacedSolid<Dim>::distance(const Vec<Dim>& x) const {
  return surface_ ? surface_->distance(x) : body_.distance_in(pose_, x);
}

template <int Dim>
Vec<Dim> PlacedSolid<Dim>::carried_to(const PlacedSolid& other, const Vec<Dim>& x) const {
  if (!surface_) return truncate<Dim>(other.pose_.apply(pose_.to_rest(extend<Dim>(x))));
  SurfacePoint<Dim> near;
  if (!surface_->nearest(x, near)) return x;
  return x - position(near, points_) + position(near, other.points_);
}

template class PlacedSolid<2>;
template class PlacedSolid<3>;

}  // namespace seiche
