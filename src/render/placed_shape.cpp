#include "render/placed_shape.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "base/solid_spec.h"
#include "geometry/shapes/closed_surface.h"
#include "render/frame.h"

namespace seiche::render {
namespace {

constexpr double finer = 8;             // cells of the contours of formulas, in one of the frame
constexpr double most_samples = 1.0e6;  // of a contour

struct RestBox {
  Vec<2> lower, upper;
};

// Box in the rest pose around the part of a solid that the frame shows.
RestBox box_at_rest(const LoadedFrame& frame, int solid, const PlacedShape<2>& shape) {
  std::vector<Vec3> points;
  bool corner_inside = false;
  for (int c = 0; c < 4; ++c) {
    points.emplace_back((c & 1 ? frame.domain.upper : frame.domain.lower)[0],
                        (c & 2 ? frame.domain.upper : frame.domain.lower)[1], 0);
    corner_inside = corner_inside || shape(points.back()) < 0;
  }
  if (!corner_inside) points.clear();
  const SolidMesh& solids = frame.solids;
  for (std::size_t i = 0; i < solids.mesh.segments.size() && i < solids.solid.size(); ++i)
    if (solids.solid[i] == solid) points.push_back(solids.mesh.points[std::size_t(solids.mesh.segments[i][0])]);
  RestBox box{Vec<2>::Constant(1e300), Vec<2>::Constant(-1e300)};
  for (const Vec3& point : points) {
    const Vec<2> rest = shape.to_rest(point).head<2>();
    box.lower = box.lower.cwiseMin(rest), box.upper = box.upper.cwiseMax(rest);
  }
  return box;
}

// The outline at rest; closed, with the inside to the left.
SurfaceMesh outline_of(const ShapeSpec& spec, const RestBox& box, double h) {
  const Vec<2> size = box.upper - box.lower + Vec<2>::Constant(4 * h);
  const double spacing = std::max(h / finer, std::sqrt(size[0] * size[1] / most_samples));
  const Vec<2> margin = Vec<2>::Constant(2 * h);
  return contact_surface<2>(spec, {spacing, nullptr}, box.lower - margin, box.upper + margin);
}

bool agrees(const PlacedShape<2>& shape, const SolidMesh& solids, int solid, double h) {
  for (std::size_t i = 0; i < solids.mesh.segments.size() && i < solids.solid.size(); ++i) {
    if (solids.solid[i] != solid) continue;
    for (const int point : solids.mesh.segments[i])
      if (!(std::abs(shape(solids.mesh.points[std::size_t(point)])) < h)) return false;
  }
  return true;
}

bool has_segments(const SolidMesh& solids, int solid) {
  return std::find(solids.solid.begin(), solids.solid.end(), solid) != solids.solid.end();
}

// The frame's solids without the segments of one.
void remove_solid(SolidMesh& solids, int solid) {
  SolidMesh kept;
  kept.mesh.points = solids.mesh.points;
  for (std::size_t i = 0; i < solids.mesh.segments.size() && i < solids.solid.size(); ++i) {
    if (solids.solid[i] == solid) continue;
    kept.mesh.segments.push_back(solids.mesh.segments[i]);
    kept.solid.push_back(solids.solid[i]);
  }
  solids = std::move(kept);
}

void add_outline(SolidMesh& solids, int solid, const SurfaceMesh& outline, const PlacedShape<2>& shape) {
  const int first = int(solids.mesh.points.size());
  for (const Vec3& point : outline.points) solids.mesh.points.push_back(shape.place(point));
  for (const auto& [a, b] : outline.segments) {
    solids.mesh.segments.push_back({first + a, first + b});
    solids.solid.push_back(solid);
  }
}

void refine_outline(LoadedFrame& frame, const SolidSpec& solid, int n, double h) {
  const PlacedShape<2> shape(solid, h / finer, frame.time);
  if (!agrees(shape, frame.solids, n, h)) return;
  const SurfaceMesh outline = outline_of(solid.shape, box_at_rest(frame, n, shape), h);
  remove_solid(frame.solids, n);
  add_outline(frame.solids, n, outline, shape);
}

}  // namespace

template <int Dim>
PlacedShape<Dim>::PlacedShape(const SolidSpec& solid, double cell_size, double time)
    : center_(solid.motion.center), shape_(make_shape<Dim>(solid.shape, {cell_size, nullptr})) {
  if (!solid.kind.is_prescribed()) return;
  translate_ = VectorExpression(solid.motion.translate)(Vec3::Zero(), time);
  const double degrees = Expression(solid.motion.degrees)(Vec3::Zero(), time);
  back_ = Eigen::AngleAxisd(-degrees * M_PI / 180, solid.motion.axis.normalized()).toRotationMatrix();
}

template <int Dim>
double PlacedShape<Dim>::operator()(const Vec3& x) const {
  return (*shape_)(to_rest(x).template head<Dim>());
}

template class PlacedShape<2>;
template class PlacedShape<3>;

void refine_outlines(LoadedFrame& frame, const std::vector<SolidSpec>& solids) {
  if (frame.dimension != 2 || frame.solids.mesh.segments.empty()) return;
  const double h = frame.phi ? frame.phi->h : frame.quantity ? frame.quantity->h : 0;
  for (std::size_t n = 0; n < solids.size() && h > 0; ++n) {
    if (solids[n].kind.is_free() || !has_segments(frame.solids, int(n))) continue;
    try {
      refine_outline(frame, solids[n], int(n), h);
    } catch (const Error&) {  // such as a file of the shape that is gone: the frame's outline stays
    }
  }
}

}  // namespace seiche::render
