#include "render/surface_refiner.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "geometry/mesh/facets.h"
#include "geometry/shapes/closed_surface.h"
#include "render/placed_shape.h"

namespace seiche::render {
namespace {

template <int Dim>
constexpr double finer = Dim == 2 ? 8 : 4;  // cells of the contours of formulas, in one of the frame
constexpr double most_samples = 1.0e6;      // of a contour
constexpr double room_to_move = 1;          // cells: the frame's facets of a moving solid differ by less

template <int Dim>
std::vector<std::array<int, Dim>>& facets_in(SurfaceMesh& mesh) {
  if constexpr (Dim == 2)
    return mesh.segments;
  else
    return mesh.triangles;
}

template <int Dim>
struct RestBox {
  Vec<Dim> lower, upper;
};

// Calls visit(facet) for each facet of a solid that the frame has.
template <int Dim, class Visit>
void visit_facets(const SolidMesh& solids, int solid, const Visit& visit) {
  const auto& facets = facets_of<Dim>(solids.mesh);
  for (std::size_t i = 0; i < facets.size() && i < solids.solid.size(); ++i)
    if (solids.solid[i] == solid) visit(facets[i]);
}

// Box in the rest pose around the part of a solid that the frame shows.
template <int Dim>
RestBox<Dim> box_at_rest(const LoadedFrame& frame, int solid, const PlacedShape<Dim>& shape) {
  std::vector<Vec3> points;
  bool corner_inside = false;
  for (int c = 0; c < 1 << Dim; ++c) {
    Vec3 corner = Vec3::Zero();
    for (int a = 0; a < Dim; ++a) corner[a] = ((c >> a) & 1 ? frame.domain.upper : frame.domain.lower)[a];
    points.push_back(corner);
    corner_inside = corner_inside || shape(corner) < 0;
  }
  if (!corner_inside) points.clear();
  visit_facets<Dim>(frame.solids, solid,
                    [&](const auto& facet) { points.push_back(frame.solids.mesh.points[std::size_t(facet[0])]); });
  RestBox<Dim> box{Vec<Dim>::Constant(1e300), Vec<Dim>::Constant(-1e300)};
  for (const Vec3& point : points) {
    const Vec<Dim> rest = truncate<Dim>(shape.to_rest(point));
    box.lower = box.lower.cwiseMin(rest), box.upper = box.upper.cwiseMax(rest);
  }
  return box;
}

// The box with room for edges that the frame's cells cut off. Solids that stand end beyond the domain as in the frame.
template <int Dim>
RestBox<Dim> with_room(RestBox<Dim> box, const LoadedFrame& frame, bool stands, double h) {
  constexpr double room = 2, beyond = 1.5;  // cells; contact_surface() goes a little further
  box.lower.array() -= room * h, box.upper.array() += room * h;
  for (int a = 0; a < Dim && stands; ++a) {
    box.lower[a] = std::max(box.lower[a], frame.domain.lower[a] - beyond * h);
    box.upper[a] = std::min(box.upper[a], frame.domain.upper[a] + beyond * h);
  }
  return box;
}

// The surface at rest within a box; closed, facing outwards. h: m, of a cell of the frame. Empty if it would be no
// finer than that.
template <int Dim>
SurfaceMesh surface_at_rest(const ShapeSpec& spec, const RestBox<Dim>& box, double h) {
  const Vec<Dim> size = box.upper - box.lower;
  const double spacing = std::max(h / finer<Dim>, std::pow(size.prod() / most_samples, 1.0 / Dim));
  if (Dim == 3 && spacing > 0.7 * h) return {};
  return contact_surface<Dim>(spec, {spacing, nullptr}, box.lower, box.upper);
}

template <int Dim>
bool agrees(const PlacedShape<Dim>& shape, const SolidMesh& solids, int solid, double h) {
  bool all = true;
  visit_facets<Dim>(solids, solid, [&](const auto& facet) {
    for (const int point : facet) all = all && std::abs(shape(solids.mesh.points[std::size_t(point)])) < h;
  });
  return all;
}

bool has_facets(const SolidMesh& solids, int solid) {
  return std::find(solids.solid.begin(), solids.solid.end(), solid) != solids.solid.end();
}

// The frame's solids without the facets of one.
template <int Dim>
void remove_solid(SolidMesh& solids, int solid) {
  SolidMesh kept;
  kept.mesh.points = solids.mesh.points;
  const auto& facets = facets_of<Dim>(solids.mesh);
  for (std::size_t i = 0; i < facets.size() && i < solids.solid.size(); ++i) {
    if (solids.solid[i] == solid) continue;
    facets_in<Dim>(kept.mesh).push_back(facets[i]);
    kept.solid.push_back(solids.solid[i]);
  }
  solids = std::move(kept);
}

template <int Dim>
void add_surface(SolidMesh& solids, int solid, const SurfaceMesh& surface, const PlacedShape<Dim>& shape) {
  const int first = int(solids.mesh.points.size());
  for (const Vec3& point : surface.points) solids.mesh.points.push_back(shape.place(point));
  for (std::array<int, Dim> facet : facets_of<Dim>(surface)) {
    for (int& point : facet) point += first;
    facets_in<Dim>(solids.mesh).push_back(facet);
    solids.solid.push_back(solid);
  }
}

// True if the surface within `kept` serves for `wanted` too: nothing is missing, and little is too much.
template <int Dim>
bool serves(const RestBox<Dim>& kept, const RestBox<Dim>& wanted, double h) {
  const double most = 2 * room_to_move * h;
  return (kept.lower.array() <= wanted.lower.array()).all() && (kept.upper.array() >= wanted.upper.array()).all() &&
         (wanted.lower - kept.lower).maxCoeff() <= most && (kept.upper - wanted.upper).maxCoeff() <= most;
}

// True if the scene tells the surface of a solid better than the frame. In 3D that is so of formulas and level sets.
bool is_refinable(const SolidSpec& solid, int dimension) {
  const std::string& kind = solid.shape.kind;
  const bool is_sampled = kind == "expression" || kind == "level_set";
  return !solid.kind.is_free() && !solid.kind.follows_meshes && (dimension == 2 || (is_sampled && !solid.shape.invert));
}

}  // namespace

template <int Dim>
void SurfaceRefiner::refine_solid(LoadedFrame& frame, std::size_t n, double h) {
  const SolidSpec& solid = solids_[n];
  auto& all = std::get<std::vector<Kept<Dim>>>(kept_);
  all.resize(solids_.size());
  Kept<Dim>& kept = all[n];
  if (kept.h != h) kept = {h, make_shape<Dim>(solid.shape, {h / finer<Dim>, nullptr}), {}, {}, {}};
  const PlacedShape<Dim> shape(solid, kept.shape, frame.time);
  if (!agrees<Dim>(shape, frame.solids, int(n), h)) return;
  const bool stands = !solid.kind.is_prescribed();
  RestBox<Dim> box = with_room<Dim>(box_at_rest<Dim>(frame, int(n), shape), frame, stands, h);
  if (kept.surface.points.empty() || !serves<Dim>({kept.lower, kept.upper}, box, h)) {
    if (!stands) box.lower.array() -= room_to_move * h, box.upper.array() += room_to_move * h;
    kept.lower = box.lower, kept.upper = box.upper;
    kept.surface = surface_at_rest<Dim>(solid.shape, box, h);
  }
  if (kept.surface.points.empty()) return;
  remove_solid<Dim>(frame.solids, int(n));
  add_surface<Dim>(frame.solids, int(n), kept.surface, shape);
}

void SurfaceRefiner::refine(LoadedFrame& frame) {
  const double h = frame.phi ? frame.phi->h : frame.quantity ? frame.quantity->h : 0;
  for (std::size_t n = 0; n < solids_.size() && h > 0; ++n) {
    if (!is_refinable(solids_[n], frame.dimension) || !has_facets(frame.solids, int(n))) continue;
    try {
      frame.dimension == 2 ? refine_solid<2>(frame, n, h) : refine_solid<3>(frame, n, h);
    } catch (const Error&) {  // such as a file of the shape that is gone: the frame's surface stays
    }
  }
}

}  // namespace seiche::render
