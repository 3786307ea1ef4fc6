#include "exact_intersections.h"
#include "base/scene.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace seiche::exact {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Shape>
struct Element {
  std::size_t surface;
  Mobility mobility;
  Shape shape;
  std::vector<int> corners;  // points of the surface
};

std::vector<Element<Kernel::Triangle_3>> triangles(const std::vector<PlacedSurface>& surfaces) {
  std::vector<Element<Kernel::Triangle_3>> list;
  const auto point = [](const Vec3& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const auto& points = surfaces[k].mesh.points;
    for (const auto& t : surfaces[k].mesh.triangles)
      list.push_back({k,
                      surfaces[k].mobility,
                      {point(points[t[0]]), point(points[t[1]]), point(points[t[2]])},
                      {t.begin(), t.end()}});
  }
  return list;
}

std::vector<Element<Kernel::Segment_2>> segments(const std::vector<PlacedSurface>& surfaces) {
  std::vector<Element<Kernel::Segment_2>> list;
  const auto point = [](const Vec3& x) { return Kernel::Point_2(x[0], x[1]); };
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const auto& points = surfaces[k].mesh.points;
    for (const auto& s : surfaces[k].mesh.segments)
      list.push_back({k, surfaces[k].mobility, {point(points[s[0]]), point(points[s[1]])}, {s.begin(), s.end()}});
  }
  return list;
}

template <class Shape>
std::vector<int> common_corners(const Element<Shape>& a, const Element<Shape>& b) {
  std::vector<int> common;
  for (int corner : a.corners)
    if (std::find(b.corners.begin(), b.corners.end(), corner) != b.corners.end()) common.push_back(corner);
  return common;
}

Kernel::Segment_3 side_opposite(const Element<Kernel::Triangle_3>& a, int corner) {
  const int at = int(std::find(a.corners.begin(), a.corners.end(), corner) - a.corners.begin());
  return {a.shape.vertex(at + 1), a.shape.vertex(at + 2)};
}

// Pairs of elements of one surface.
bool crosses_itself(const Element<Kernel::Triangle_3>& a, const Element<Kernel::Triangle_3>& b) {
  const std::vector<int> common = common_corners(a, b);
  if (common.empty()) return CGAL::do_intersect(a.shape, b.shape);
  if (common.size() > 1) return false;
  return CGAL::do_intersect(side_opposite(a, common[0]), b.shape) ||
         CGAL::do_intersect(side_opposite(b, common[0]), a.shape);
}
bool crosses_itself(const Element<Kernel::Segment_2>& a, const Element<Kernel::Segment_2>& b) {
  return common_corners(a, b).empty() && CGAL::do_intersect(a.shape, b.shape);
}

template <int Dim, class Shape>
int intersecting_pairs(const std::vector<Element<Shape>>& list) {
  using Handle = typename std::vector<Element<Shape>>::const_iterator;
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, Dim, Handle>;
  std::vector<Box> boxes;
  for (auto e = list.begin(); e != list.end(); ++e) boxes.emplace_back(e->shape.bbox(), e);
  int found = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (a.handle()->surface == b.handle()->surface) {
      found += a.handle()->mobility == Mobility::deformable && crosses_itself(*a.handle(), *b.handle());
      return;
    }
    if (a.handle()->mobility == Mobility::prescribed && b.handle()->mobility == Mobility::prescribed) return;
    if (CGAL::do_intersect(a.handle()->shape, b.handle()->shape)) ++found;
  });
  return found;
}

// Half the solid angle of a triangle seen from the origin (Van Oosterom, Strackee 1983).
double half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double x = a.norm(), y = b.norm(), z = c.norm();
  return std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
}

int winding(const SurfaceMesh& mesh, const Vec3& x) {
  constexpr double pi = 3.14159265358979323846;
  Vec3 lower = Vec3::Constant(1e300), upper = -lower;
  for (const Vec3& p : mesh.points) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  if ((x.array() < lower.array()).any() || (x.array() > upper.array()).any()) return 0;
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += half_solid_angle(mesh.points[t[0]] - x, mesh.points[t[1]] - x, mesh.points[t[2]] - x);
  for (const auto& s : mesh.segments) {
    const Vec3 a = mesh.points[s[0]] - x, b = mesh.points[s[1]] - x;
    sum += std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
  }
  return int(std::lround(sum / (2 * pi)));
}

}  // namespace

int intersections(const std::vector<PlacedSurface>& surfaces) {
  return intersecting_pairs<3>(triangles(surfaces)) + intersecting_pairs<2>(segments(surfaces));
}

int points_outside(const std::vector<PlacedSurface>& surfaces, const Scene& scene) {
  int found = 0;
  for (const PlacedSurface& s : surfaces)
    for (const Vec3& x : s.mobility != Mobility::prescribed ? s.mesh.points : std::vector<Vec3>())
      for (int a = 0; a < scene.dimension; ++a)
        for (int side = 0; side < 2; ++side) {
          const SideType type = scene.domain.sides[a][side].type;
          if (type == SideType::outflow || type == SideType::periodic) continue;
          if (side == 0 ? x[a] <= scene.domain.lower[a] : x[a] >= scene.domain.upper[a]) ++found;
        }
  return found;
}

std::vector<int> windings(const std::vector<PlacedSurface>& surfaces) {
  std::vector<int> list;
  for (const PlacedSurface& free : surfaces) {
    if (free.mobility == Mobility::prescribed || free.mesh.points.empty()) continue;
    for (const PlacedSurface& other : surfaces)
      if (&other != &free) list.push_back(winding(other.mesh, free.mesh.points[0]));
  }
  return list;
}

}  // namespace seiche::exact
