#include "geometry/shapes/tessellate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

namespace seiche {
namespace {

constexpr int fewest_round = 16, most_round_2d = 256, most_round_cylinder = 128, most_round_capsule = 48;
constexpr int fewest_levels = 1, most_levels = 3;  // subdivisions of icospheres: 42 to 642 points

// The smallest multiple of four n with r (1 - cos(pi/n)) <= chord, within bounds.
int count_round(double radius, double chord, int most) {
  const double cosine = std::max(1 - chord / radius, 0.0);
  const double wanted = cosine < 1 ? std::numbers::pi / std::acos(cosine) : double(most);
  return int(std::ceil(std::clamp(wanted, double(fewest_round), double(most)) / 4)) * 4;
}

// 2D: the closed polyline through counter-clockwise points.
SurfaceMesh outline(std::vector<Vec3> points) {
  SurfaceMesh mesh{std::move(points), {}, {}};
  const int n = int(mesh.points.size());
  for (int i = 0; i < n; ++i) mesh.segments.push_back({i, (i + 1) % n});
  return mesh;
}

// 2D: adds `count` points on a circle, from angle `begin` (rad) in steps of 2 pi / round.
void add_arc(const Vec3& center, double radius, double begin, int count, int round, std::vector<Vec3>& points) {
  for (int i = 0; i < count; ++i) {
    const double angle = begin + 2 * std::numbers::pi * i / round;
    points.push_back(center + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
}

SurfaceMesh icosahedron() {
  const double g = std::numbers::phi;
  SurfaceMesh mesh;
  mesh.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Vec3& p : mesh.points) p.normalize();
  return mesh;
}

// Splits each triangle of a mesh of the unit sphere into four.
SurfaceMesh subdivide(const SurfaceMesh& coarse) {
  SurfaceMesh fine{coarse.points, {}, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int i, int j) {
    const auto [entry, is_new] = middles.try_emplace(std::minmax(i, j), int(fine.points.size()));
    const Vec3 sum = coarse.points[std::size_t(i)] + coarse.points[std::size_t(j)];
    if (is_new) fine.points.push_back(sum.normalized());
    return entry->second;
  };
  for (const auto& [i, j, k] : coarse.triangles) {
    const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
    fine.triangles.insert(fine.triangles.end(), {{i, ij, ki}, {j, jk, ij}, {k, ki, jk}, {ij, jk, ki}});
  }
  return fine;
}

// Largest distance of a unit sphere's triangles inside the sphere.
double chord_of(const SurfaceMesh& unit) {
  double least = 1;
  for (const auto& [i, j, k] : unit.triangles) {
    const Vec3 &a = unit.points[std::size_t(i)], &b = unit.points[std::size_t(j)], &c = unit.points[std::size_t(k)];
    least = std::min(least, (b - a).cross(c - a).normalized().dot(a));
  }
  return 1 - least;
}

SurfaceMesh icosphere(const Vec3& center, double radius, double chord) {
  SurfaceMesh mesh = icosahedron();
  for (int level = 0; level < most_levels; ++level) {
    if (level >= fewest_levels && chord_of(mesh) * radius <= chord) break;
    mesh = subdivide(mesh);
  }
  for (Vec3& p : mesh.points) p = center + radius * p;
  return mesh;
}

// Profile of a surface of revolution: points (distance along the axis, distance from it). The first and the last point
// lie on the axis.
using Profile = std::vector<std::array<double, 2>>;

// Adds the triangles between two rings of `round` points, or a ring and a pole. `low` and `high` are their first
// points.
enum class SpherePart { lower_cap, band, upper_cap };
void add_part(SpherePart part, int low, int high, int round, SurfaceMesh& mesh) {
  for (int j = 0; j < round; ++j) {
    const int next = (j + 1) % round;
    if (part == SpherePart::lower_cap) mesh.triangles.push_back({low, high + next, high + j});
    if (part == SpherePart::upper_cap) mesh.triangles.push_back({low + j, low + next, high});
    if (part != SpherePart::band) continue;
    mesh.triangles.push_back({low + j, low + next, high + next});
    mesh.triangles.push_back({low + j, high + next, high + j});
  }
}

SurfaceMesh revolve(const Vec3& from, const Vec3& axis, const Profile& profile, int round) {
  const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
  SurfaceMesh mesh;
  mesh.points.push_back(from + profile.front()[0] * axis);
  for (std::size_t k = 1; k + 1 < profile.size(); ++k) {
    const auto [along, across] = profile[k];
    const int ring = int(mesh.points.size());
    for (int j = 0; j < round; ++j) {
      const double angle = 2 * std::numbers::pi * j / round;
      mesh.points.push_back(from + along * axis + across * (std::cos(angle) * u + std::sin(angle) * v));
    }
    add_part(k == 1 ? SpherePart::lower_cap : SpherePart::band, k == 1 ? 0 : ring - round, ring, round, mesh);
  }
  const int pole = int(mesh.points.size());
  mesh.points.push_back(from + profile.back()[0] * axis);
  add_part(SpherePart::upper_cap, pole - round, pole, round, mesh);
  return mesh;
}

// Two quarter circles of `quarter` chords each, and a straight line of length `length` between them.
Profile capsule_profile(double length, double radius, int quarter) {
  Profile profile{{-radius, 0}};
  for (int end = 0; end < 2; ++end) {
    for (int k = 1 - end; k <= quarter - end; ++k) {
      const double angle = std::numbers::pi / 2 * (k + (end - 1) * quarter) / quarter;
      profile.push_back({end * length + radius * std::sin(angle), radius * std::cos(angle)});
    }
  }
  profile.push_back({length + radius, 0});
  return profile;
}

template <int Dim>
struct Axis {
  Vec3 from, to, direction;
  double length;
  explicit Axis(const ShapeSpec& s)
      : from(extend<Dim>(truncate<Dim>(s.from))),
        to(extend<Dim>(truncate<Dim>(s.to))),
        direction((to - from).normalized()),
        length((to - from).norm()) {}
};

}  // namespace

// Corner i is at the far end of edge a if bit a of i is set.
template <>
SurfaceMesh block_surface<3>(const Vec3& corner, const std::array<Vec3, 3>& e) {
  SurfaceMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.push_back(corner + (i & 1) * e[0] + (i >> 1 & 1) * e[1] + (i >> 2) * e[2]);
  for (int a = 0; a < 3; ++a) {
    const int b = 1 << (a + 1) % 3, c = 1 << (a + 2) % 3, far = 1 << a;
    mesh.triangles.insert(mesh.triangles.end(), {{0, c, b + c}, {0, b + c, b}});
    mesh.triangles.insert(mesh.triangles.end(), {{far, far + b, far + b + c}, {far, far + b + c, far + c}});
  }
  return mesh;
}

template <>
SurfaceMesh block_surface<2>(const Vec3& corner, const std::array<Vec3, 3>& e) {
  return outline({corner, corner + e[0], corner + e[0] + e[1], corner + e[1]});
}

template <int Dim>
SurfaceMesh tessellate_box(const ShapeSpec& s, double) {
  const Vec3 lower = extend<Dim>(truncate<Dim>(s.lower)), size = s.upper - s.lower;
  return block_surface<Dim>(lower, {size[0] * Vec3::UnitX(), size[1] * Vec3::UnitY(), size[2] * Vec3::UnitZ()});
}

template <>
SurfaceMesh tessellate_sphere<3>(const ShapeSpec& s, double chord) {
  return icosphere(s.center, s.radius, chord);
}

template <>
SurfaceMesh tessellate_sphere<2>(const ShapeSpec& s, double chord) {
  const int round = count_round(s.radius, chord, most_round_2d);
  std::vector<Vec3> points;
  add_arc({s.center[0], s.center[1], 0}, s.radius, 0, round, round, points);
  return outline(std::move(points));
}

template <>
SurfaceMesh tessellate_cylinder<3>(const ShapeSpec& s, double chord) {
  const Axis<3> a(s);
  const Profile profile{{0, 0}, {0, s.radius}, {a.length, s.radius}, {a.length, 0}};
  return revolve(a.from, a.direction, profile, count_round(s.radius, chord, most_round_cylinder));
}

template <>
SurfaceMesh tessellate_cylinder<2>(const ShapeSpec& s, double) {
  const Axis<2> a(s);
  const Vec3 across = Vec3::UnitZ().cross(a.direction);
  return block_surface<2>(a.from - s.radius * across, {a.to - a.from, 2 * s.radius * across, Vec3::UnitZ()});
}

template <>
SurfaceMesh tessellate_capsule<3>(const ShapeSpec& s, double chord) {
  const Axis<3> a(s);
  if (a.length == 0) return icosphere(s.from, s.radius, chord);
  // The chord errors along and around the axis add up.
  const int round = count_round(s.radius, chord / 2, most_round_capsule);
  return revolve(a.from, a.direction, capsule_profile(a.length, s.radius, round / 4), round);
}

template <>
SurfaceMesh tessellate_capsule<2>(const ShapeSpec& s, double chord) {
  const Axis<2> a(s);
  const int round = count_round(s.radius, chord, most_round_2d), ends = a.length > 0 ? 1 : 0;
  const double begin = std::atan2(a.direction[1], a.direction[0]) - std::numbers::pi / 2;
  std::vector<Vec3> points;
  add_arc(a.to, s.radius, begin, round / 2 + ends, round, points);
  add_arc(a.from, s.radius, begin + std::numbers::pi, round / 2 + ends, round, points);
  return outline(std::move(points));
}

template SurfaceMesh tessellate_box<2>(const ShapeSpec&, double);
template SurfaceMesh tessellate_box<3>(const ShapeSpec&, double);

}  // namespace seiche
