// Exact detection of self-intersections: crossings are found, sharp bends are not reported.
#include <catch2/catch.hpp>
#include <chrono>
#include <random>

#include "base/error.h"
#include "geometry/mesh/exact_orientation.h"
#include "geometry/mesh/intersections.h"
#include "unit/geometry/mesh_files.h"

namespace intersections_tests {
using namespace seiche;
using namespace seiche::mesh_files;

namespace {

SurfaceMesh pair_of(const std::vector<Vec3>& points, const std::array<int, 3>& s, const std::array<int, 3>& t) {
  return {points, {s, t}, {}};
}

bool meet(const std::vector<Vec3>& points, const std::array<int, 3>& s, const std::array<int, 3>& t) {
  const SurfaceMesh mesh = pair_of(points, s, t);
  const bool found = mesh::intersect(mesh, s, t);
  CHECK(mesh::intersect(mesh, t, s) == found);
  for (int k = 0; k < 3; ++k) CHECK(mesh::intersect(mesh, {s[k], s[(k + 2) % 3], s[(k + 1) % 3]}, t) == found);
  return found;
}

std::string refusal(const SurfaceMesh& mesh) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  try {
    read_closed_mesh(folder.write("crossed.obj", obj(mesh)), notes);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  return {};
}

}  // namespace

TEST_CASE("orientation is exact where doubles are not") {
  const Vec3 a(0, 0, 0), b(1e-3, 1, 0.1), c = 3 * b;
  CHECK(orientation(a, b, Vec3(3 * b[0], 3 * b[1], 0), 2) == orientation(a, b, c, 2));
  // Points one unit in the last place off a line, and a plane through them.
  const double e = std::ldexp(1.0, -52);
  CHECK(orientation(Vec3(0.5, 0.5, 0), Vec3(12, 12, 0), Vec3(24, 24 + 16 * e, 0), 2) == 1);
  CHECK(orientation(Vec3(0.5, 0.5, 0), Vec3(12, 12, 0), Vec3(24, 24, 0), 2) == 0);
  CHECK(orientation(Vec3(0.5, 0.5 + e / 2, 0), Vec3(12, 12, 0), Vec3(24, 24, 0), 2) == 1);
  const Vec3 p(0.1, 0.7, 0.8), q(12, 0.3, 12.3), r(-3, 5, 2);
  const Vec3 sum(p[0] + 0, p[1], p[2]);
  CHECK(orientation(p, q, r, sum) == 0);
  const Vec3 u(1, 0, 1), v(0, 1, 1), far(3e15, 4e15, 7e15);  // the plane z = x + y
  CHECK(orientation(a, u, v, far) == 0);
  CHECK(orientation(a, u, v, Vec3(3e15, 4e15, 7e15 + 1)) == 1);
  CHECK(orientation(a, u, v, Vec3(3e15, 4e15, 7e15 - 1)) == -1);
}

TEST_CASE("pairs of triangles: apart, crossing, touching, sharing corners and edges") {
  const std::vector<Vec3> x{{0, 0, 0},       {1, 0, 0},          {0, 1, 0},        {0.2, 0.2, -1}, {0.2, 0.2, 1},
                            {2, 2, 0.5},     {0.2, 0.3, 0},      {-1, -1, 0},      {1, 1, 0},      {0.5, 0.5, 1},
                            {0.25, 0.25, 0}, {0.25, 0.25, 1e-9}, {0.3, 0.4, 1e-9}, {-1, 0, 0}};
  CHECK(meet(x, {0, 1, 2}, {3, 4, 5}));          // through the middle
  CHECK_FALSE(meet(x, {0, 1, 2}, {4, 5, 9}));    // above
  CHECK(meet(x, {0, 1, 2}, {6, 4, 5}));          // corner on the face
  CHECK(meet(x, {0, 1, 2}, {7, 10, 13}));        // coplanar
  CHECK_FALSE(meet(x, {0, 1, 2}, {11, 12, 4}));  // 1e-9 above
  CHECK_FALSE(meet(x, {0, 1, 2}, {0, 4, 9}));    // one shared corner
  CHECK(meet(x, {0, 1, 2}, {0, 3, 4}));          // one shared corner, opposite side crosses
  CHECK(meet(x, {0, 1, 2}, {0, 8, 9}));          // one shared corner, an edge in the plane
  CHECK_FALSE(meet(x, {0, 1, 2}, {0, 7, 13}));   // one shared corner, coplanar, opposite
  CHECK_FALSE(meet(x, {0, 1, 2}, {0, 1, 4}));    // folded up
  CHECK_FALSE(meet(x, {0, 1, 2}, {0, 1, 11}));   // almost folded back
  CHECK(meet(x, {0, 1, 2}, {0, 1, 10}));         // folded back
  CHECK_FALSE(meet(x, {0, 1, 2}, {1, 2, 8}));    // flat
}

TEST_CASE("clean surfaces have no intersections, however sharp") {
  CHECK(mesh::self_intersections(cube()).empty());
  CHECK(mesh::self_intersections(sphere(Vec3(0.1, 0.2, 0.3), 0.7, 3)).empty());
  SurfaceMesh needle = sphere(Vec3(0, 0, 0), 1, 3);
  for (Vec3& p : needle.points) p[2] *= 1e-7;
  CHECK(mesh::self_intersections(needle).empty());
  CHECK(mesh::self_intersections(joined(cube(), cube(Vec3(0.25, 0.25, 0.25), 0.5))).empty());
}

TEST_CASE("meshes that cross themselves are refused with the pair and its place") {
  CHECK_THAT(refusal(joined(cube(), cube(Vec3(0.5, 0.25, 0.125)))),
             Catch::Contains("crossed.obj: ") && Catch::Contains("intersects itself") &&
                 Catch::Contains("the first 3 at (0.333333, 0.333333, 1) and"));
  SurfaceMesh poked = sphere(Vec3(0, 0, 0), 1, 2);
  poked.points[0] *= -1.5;
  CHECK_THAT(refusal(poked), Catch::Contains("intersects itself"));
  SurfaceMesh folded = cube();  // pulls a point of the top across one of its edges, within the plane
  folded.points.push_back(Vec3(0.5, -0.25, 1));
  folded.triangles[2] = {4, 5, 8};
  folded.triangles.push_back({5, 6, 8});
  folded.triangles.push_back({6, 4, 8});
  CHECK_THAT(refusal(folded), Catch::Contains("intersects itself in"));
}

TEST_CASE("numbers of triangles are those of the file, whatever was dropped before") {
  SurfaceMesh mesh = joined(cube(), cube(Vec3(0.5, 0.25, 0.125)));
  mesh.triangles.insert(mesh.triangles.begin(), 2, {5, 5, 6});
  CHECK_THAT(refusal(mesh), Catch::Contains("the first 5 at (0.333333, 0.333333, 1)"));
}

// Two balls at distances at which they just touch or just do not, rotated at random.
TEST_CASE("the tree misses no pair that trying all would find") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const SurfaceMesh mesh =
        joined(sphere(Vec3(0, 0, 0), 1, 1), sphere(Vec3(shift(random), shift(random), 2.2 * shift(random)), 1, 1));
    std::vector<std::array<int, 2>> all;
    for (int s = 0; s < int(mesh.triangles.size()); ++s)
      for (int t = s + 1; t < int(mesh.triangles.size()); ++t)
        if (mesh::intersect(mesh, mesh.triangles[s], mesh.triangles[t])) all.push_back({s, t});
    CHECK(mesh::self_intersections(mesh) == all);
  }
}

TEST_CASE("a hundred thousand triangles are looked through in a second or two") {
  const SurfaceMesh ball = sphere(Vec3(0, 0, 0), 1, 7);
  REQUIRE(ball.triangles.size() > 80000);
  const auto start = std::chrono::steady_clock::now();
  CHECK(mesh::self_intersections(ball).empty());
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  UNSCOPED_INFO(seconds.count());
  CHECK(seconds.count() < 10);  // 0.3 s alone; debug builds and busy machines are slower
}

}  // namespace intersections_tests
