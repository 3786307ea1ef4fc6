// Close pairs of edges and triangles: none is missed, and only few are found if very many share a point.
#include <catch2/catch.hpp>

#include <random>

#include "geometry/mesh/box_pairs.h"
#include "geometry/mesh/intersections.h"
#include "geometry/mesh/pairs.h"
#include "unit/geometry/mesh_files.h"

namespace mesh_pairs_tests {
using namespace seiche;
using namespace seiche::mesh_files;

namespace {

// A cone over a polygon of `count` corners, whose distance from the axis varies by `wave`. The floor is a fan too.
SurfaceMesh cone(int count, double wave) {
  SurfaceMesh mesh{{Vec3(0.1, 0.2, 1), Vec3(0.1, 0.2, 0)}, {}, {}};
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / count, r = 0.5 + wave * (i % 2 ? 1 : -1);
    mesh.points.push_back(Vec3(0.1 + r * std::cos(angle), 0.2 + r * std::sin(angle), 0));
  }
  for (int i = 0; i < count; ++i) {
    const int a = 2 + i, b = 2 + (i + 1) % count;
    mesh.triangles.push_back({0, a, b});
    mesh.triangles.push_back({1, b, a});
  }
  return mesh;
}

std::vector<mesh::Edge> edges_of(const SurfaceMesh& mesh) {
  std::vector<mesh::Edge> edges;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if (t[k] < t[(k + 1) % 3]) edges.push_back({t[k], t[(k + 1) % 3]});
  return edges;
}

std::vector<std::array<int, 2>> all_intersections(const SurfaceMesh& mesh) {
  std::vector<std::array<int, 2>> all;
  for (int s = 0; s < int(mesh.triangles.size()); ++s)
    for (int t = s + 1; t < int(mesh.triangles.size()); ++t)
      if (mesh::intersect(mesh, mesh.triangles[s], mesh.triangles[t])) all.push_back({s, t});
  return all;
}

}  // namespace

TEST_CASE("a fan of ten thousand triangles has few pairs that come close") {
  const SurfaceMesh mesh = cone(5000, 0);
  CHECK(mesh::close_pairs(mesh.points, edges_of(mesh), mesh.triangles).size() < 10 * mesh.triangles.size());
  CHECK(mesh::self_intersections(mesh).empty());
}

TEST_CASE("fans that cross themselves are found out as by trying all pairs") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.6, 0.6);
  for (int trial = 0; trial < 20; ++trial) {
    SurfaceMesh mesh = cone(60, 0.1);
    for (const int moved : {2 + trial, 40}) mesh.points[moved] += Vec3(shift(random), shift(random), shift(random));
    if (trial % 3 == 0) mesh.points[0] = Vec3(0.1, 0.2, 0);  // all in one plane
    CHECK(mesh::self_intersections(mesh) == all_intersections(mesh));
  }
}

TEST_CASE("triangles thrown at random, long and short, are found out as by trying all pairs") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-1, 1);
  const auto anywhere = [&](double size) -> Vec3 { return size * Vec3(shift(random), shift(random), shift(random)); };
  SurfaceMesh mesh;
  for (int i = 0; i < 400; ++i) {
    const Vec3 middle = anywhere(1), along = anywhere(i % 4 == 0 ? 1 : 0.1);
    const int first = int(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {middle, middle + along, middle + anywhere(0.1)});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const auto found = mesh::self_intersections(mesh);
  CHECK(found.size() > 20);
  CHECK(found == all_intersections(mesh));
}

TEST_CASE("each pair of triangles whose boxes overlap is visited once, up to a number") {
  const SurfaceMesh mesh = sphere(Vec3(0.1, 0.2, 0.3), 0.7, 3);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const auto& triangle : mesh.triangles) {
    boxes.emplace_back();
    for (const int p : triangle) boxes.back().extend(mesh.points[std::size_t(p)]);
  }
  std::vector<std::array<int, 2>> expected, visited;
  for (int s = 0; s < int(boxes.size()); ++s)
    for (int t = s + 1; t < int(boxes.size()); ++t)
      if (boxes[std::size_t(s)].intersects(boxes[std::size_t(t)])) expected.push_back({s, t});
  const auto visit = [&](int s, int t) { visited.push_back({std::min(s, t), std::max(s, t)}); };
  CHECK(mesh::TriangleBoxes(mesh).visit_pairs(double(expected.size()), visit));
  std::sort(visited.begin(), visited.end());
  CHECK(visited == expected);
  CHECK(!mesh::TriangleBoxes(mesh).visit_pairs(double(expected.size()) - 1, visit));
}

}  // namespace mesh_pairs_tests
