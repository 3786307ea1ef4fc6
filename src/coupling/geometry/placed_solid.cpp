#include "coupling/geometry/placed_solid.h"

#include <limits>

#include "coupling/geometry/periodic_places.h"
#include "geometry/mesh/segment_crossing.h"
#include "grid/loops.h"
#include "solid/body/elastic_motion.h"

namespace seiche {
namespace {

// Layer (cells) around a body of known radius in which its distance is computed.
constexpr int cells_around_body = 4;
// Radius (cells) around a sealed face over which the surface velocity of a thin body is averaged.
constexpr double spread = 1.5;

template <int Dim>
class PosedSolid : public PlacedSolid<Dim> {
 public:
  PosedSolid(const Layout<Dim>& layout, const Body<Dim>& body, const Pose& pose)
      : layout_(layout), body_(body), pose_(pose) {}

  Box<Dim> fill(NodeField<Dim>& field) const override {
    const Box<Dim> box = reach();
    const Vec<Dim> center = truncate<Dim>(pose_.apply(pose_.pivot));
    const double far = farthest();
    for_each_index_in_order(layout_, box, [&](Site s, const IVec<Dim>& i) {
      if ((layout_.position(i, node_offset<Dim>()) - center).squaredNorm() > far * far) return;
      field[s] = least_distance(layout_, i, [&](const Vec<Dim>& x) { return distance(x); });
    });
    return box;
  }
  double distance(const Vec<Dim>& x) const override { return body_.distance_in(pose_, x); }
  bool lies_between(const Vec<Dim>& x, const Vec<Dim>& y) const override { return body_.lies_between(pose_, x, y); }
  Vec<Dim> carried_to(const PlacedSolid<Dim>& other, const Vec<Dim>& x) const override {
    const Pose& there = static_cast<const PosedSolid&>(other).pose_;
    return truncate<Dim>(there.apply(pose_.to_rest(extend<Dim>(x))));
  }

 private:
  // Distance from the body's centre beyond which nodes of reach() are far from it, m. A body that a periodic side may
  // repeat has no such distance, nor has one of unknown radius.
  double farthest() const {
    bool unbounded = body_.radius() == 0;
    for (int a = 0; a < Dim; ++a) unbounded = unbounded || layout_.geometry().periodic[a];
    return unbounded ? std::numeric_limits<double>::infinity() : body_.radius() + cells_around_body * layout_.h();
  }

  // Nodes in the bounding box of the body plus `cells_around_body`. All stored nodes if the radius is unknown (0).
  Box<Dim> reach() const {
    Box<Dim> box = layout_.padded();
    if (body_.radius() == 0) return box;
    const Vec<Dim> center = truncate<Dim>(pose_.apply(pose_.pivot));
    for (int a = 0; a < Dim; ++a) {
      const double x = (center[a] - layout_.geometry().lower[a]) / layout_.h();
      const double r = body_.radius() / layout_.h() + cells_around_body, lowest = box.lower[a], highest = box.upper[a];
      box.lower[a] = int(std::clamp(std::floor(x - r), lowest, highest));
      box.upper[a] = int(std::clamp(std::ceil(x + r) + 1, lowest, highest));
      // A body near a periodic side also acts at the opposite side.
      const bool at_side = x - r <= 0 || x + r >= layout_.geometry().cells[a];
      if (layout_.geometry().periodic[a] && at_side) box.lower[a] = int(lowest), box.upper[a] = int(highest);
    }
    return box;
  }

  const Layout<Dim>& layout_;
  const Body<Dim>& body_;
  Pose pose_;
};

template <int Dim>
Vec<Dim> position(const SurfacePoint<Dim>& p, const std::vector<Vec<Dim>>& points) {
  Vec<Dim> x = Vec<Dim>::Zero();
  for (int i = 0; i < Dim; ++i) x += p.weights[i] * points[std::size_t(p.corners[i])];
  return x;
}

template <int Dim>
class DeformedSolid : public PlacedSolid<Dim> {
 public:
  DeformedSolid(const Layout<Dim>& layout, const Body<Dim>& body, const Eigen::VectorXd& displacement)
      : h_(layout.h()),
        body_(body),
        points_(surface_points(body.elastic(), displacement)),
        surface_(layout, body.elastic().surface.facets, points_) {}

  Box<Dim> fill(NodeField<Dim>& field) const override {
    surface_.fill(field);
    return surface_.box();
  }
  double distance(const Vec<Dim>& x) const override { return surface_.distance(x); }
  bool lies_between(const Vec<Dim>& x, const Vec<Dim>& y) const override {
    return surface_.first_crossing(x, y) <= 1 + crossing_slack;
  }
  // Moves x with the nearest surface point. Returns x itself if the surface is not near.
  Vec<Dim> carried_to(const PlacedSolid<Dim>& other, const Vec<Dim>& x) const override {
    SurfacePoint<Dim> near;
    if (!surface_.nearest(x, near)) return x;
    return x - position(near, points_) + position(near, static_cast<const DeformedSolid&>(other).points_);
  }
  bool deforms() const override { return true; }
  SurfaceWeights weights_at(const Vec<Dim>& x) const override {
    SurfaceWeights weights = body_.is_thin() ? surface_.mean_around(x, spread * h_) : surface_.nearest_weights(x);
    for (auto& [node, weight] : weights) node = body_.elastic().surface.nodes[std::size_t(node)];
    return weights;
  }
  bool closes_whole_faces() const override { return body_.is_thin(); }
  void measure_gaps(const std::array<Vec<Dim>, 2>& centers, SealedFace& face) const override {
    const auto gap = [&](const Vec<Dim>& x, const Vec<Dim>& across) {
      return distance(x) < 0 ? 0 : h_ * std::clamp(surface_.first_crossing(x, across), 0., 1.);
    };
    face.gaps = {gap(centers[0], centers[1]), gap(centers[1], centers[0])};
    const double along = surface_.normal_near(0.5 * (centers[0] + centers[1]))[face.axis];
    face.weight = along * along;
  }

 private:
  double h_;
  const Body<Dim>& body_;
  std::vector<Vec<Dim>> points_;
  SurfaceDistance<Dim> surface_;
};

}  // namespace

template <int Dim>
std::unique_ptr<PlacedSolid<Dim>> place_solid(const Layout<Dim>& layout, const Body<Dim>& body,
                                              const Placement& placed) {
  if (body.deforms()) return std::make_unique<DeformedSolid<Dim>>(layout, body, placed.displacement);
  return std::make_unique<PosedSolid<Dim>>(layout, body, placed.pose);
}

template std::unique_ptr<PlacedSolid<2>> place_solid<2>(const Layout<2>&, const Body<2>&, const Placement&);
template std::unique_ptr<PlacedSolid<3>> place_solid<3>(const Layout<3>&, const Body<3>&, const Placement&);

}  // namespace seiche
