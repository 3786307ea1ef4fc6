#include "render/drops.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace seiche::render {
namespace {

constexpr int corners_of_disc = 20;
constexpr std::size_t many = 4000;  // drops, from which on their spheres are coarse

Polygon disc(const vdb::Point& drop) {
  Polygon outline;
  for (int n = 0; n < corners_of_disc; ++n) {
    const double angle = 2 * M_PI * n / corners_of_disc;
    outline.emplace_back(float(drop.place[0] + drop.radius * std::cos(angle)),
                         float(drop.place[1] + drop.radius * std::sin(angle)));
  }
  return outline;
}

// The value of a drop's own for a quantity that its velocity gives.
std::optional<float> value_of(const vdb::Point& drop, const std::string& quantity) {
  if (quantity == "speed" || quantity == "vel") return float(drop.velocity.norm());
  for (int a = 0; a < 3; ++a)
    if (quantity == std::string("velocity_") + "xyz"[a]) return float(drop.velocity[a]);
  return std::nullopt;
}

// A sphere of radius 1 from an octahedron whose triangles are parted in four, `times` times.
SurfaceMesh unit_sphere(int times) {
  SurfaceMesh sphere;
  for (int a = 0; a < 3; ++a)
    for (const int sign : {1, -1}) sphere.points.push_back(sign * Vec3::Unit(a));
  sphere.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int n = 0; n < times; ++n) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), int(sphere.points.size()));
      if (is_new) sphere.points.push_back((sphere.points[std::size_t(i)] + sphere.points[std::size_t(j)]).normalized());
      return at->second;
    };
    std::vector<std::array<int, 3>> parts;
    for (const auto& [i, j, k] : sphere.triangles) {
      const int ij = middle(i, j), jk = middle(j, k), ki = middle(k, i);
      for (const std::array<int, 3>& t : {std::array<int, 3>{i, ij, ki}, {j, jk, ij}, {k, ki, jk}, {ij, jk, ki}})
        parts.push_back(t);
    }
    sphere.triangles = std::move(parts);
  }
  return sphere;
}

}  // namespace

std::vector<Disc> discs_of(const std::vector<vdb::Point>& drops, const std::string& quantity, const ColorScale& scale,
                           const Vec3f& plain) {
  std::vector<Disc> discs;
  for (const vdb::Point& drop : drops) {
    const std::optional<float> value = value_of(drop, quantity);
    discs.push_back({disc(drop), value ? color_of(scale, *value) : plain});
  }
  return discs;
}

void add_spheres(const std::vector<vdb::Point>& drops, int solid, SolidMesh& to) {
  const SurfaceMesh sphere = unit_sphere(drops.size() < many ? 2 : 1);
  for (const vdb::Point& drop : drops) {
    const int first = int(to.mesh.points.size());
    for (const Vec3& x : sphere.points) to.mesh.points.push_back(drop.place + drop.radius * x);
    for (const auto& [i, j, k] : sphere.triangles) to.mesh.triangles.push_back({first + i, first + j, first + k});
  }
  to.solid.resize(to.mesh.triangles.size(), solid);
}

Vec3f drop_color(const LiquidLook& look) {
  if (look.albedo.maxCoeff() > 0) return look.albedo;
  return look.metal.maxCoeff() > 0 ? look.metal : Vec3f(0.42f, 0.60f, 0.72f);
}

}  // namespace seiche::render
