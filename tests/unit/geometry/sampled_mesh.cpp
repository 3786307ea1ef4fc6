// Points inside a mesh, and distances sampled on voxels near the queried points.
#include <catch2/catch.hpp>

#include "geometry/mesh/inside.h"
#include "geometry/shapes/sampled_mesh.h"
#include "unit/geometry/mesh_files.h"

namespace sampled_mesh_tests {
using namespace seiche;
using namespace seiche::mesh_files;

TEST_CASE("points of a grid lie inside or outside, though rays from them run along edges and through corners") {
  const SurfaceMesh shell = joined(cube(Vec3(0.25, 0.25, 0.25), 0.5), cube(Vec3(0.375, 0.375, 0.375), 0.25));
  const SurfaceMesh ball = sphere(Vec3(0.5, 0.5, 0.5), 0.5, 1);  // corners lie on the axes through the middle
  const mesh::NearestTriangle near_shell(shell), near_ball(ball);
  for (int n = 0; n < 17 * 17 * 17; ++n) {
    const Vec3 x = Vec3(n % 17, n / 17 % 17, n / 289) / 16;
    const double box = (x - Vec3::Constant(0.5)).cwiseAbs().maxCoeff();
    CAPTURE(x.transpose());
    if (box != 0.25 && box != 0.125) CHECK(mesh::contains(near_shell, x) == (box < 0.25 && box > 0.125));
    const double r = (x - Vec3::Constant(0.5)).norm();  // the triangles lie beyond r = 0.4
    if (r < 0.4 || r > 0.5) CHECK(mesh::contains(near_ball, x) == (r < 0.4));
  }
}

TEST_CASE("a slit where triangles without area were dropped lets no ray through") {
  SurfaceMesh mesh = cube();  // one side of an edge of the top gets a point slightly off the edge
  mesh.points.push_back(Vec3(0.5, 1e-12, 1));
  mesh.triangles[2] = {4, 8, 6};
  mesh.triangles.push_back({8, 5, 6});
  const mesh::NearestTriangle nearest(mesh);
  CHECK(mesh::contains(nearest, Vec3(0.5, 5e-13, 0.5)));
  CHECK_FALSE(mesh::contains(nearest, Vec3(0.5, 5e-13, -0.5)));
  CHECK_FALSE(mesh::contains(nearest, Vec3(0.5, 5e-13, 1.5)));
}

TEST_CASE("distances to a mesh far larger than its voxels cost what is asked for") {
  const double voxel = 0.01;
  const SampledMesh distance(cube(Vec3(0, 0, 0), 1e4), voxel, 5);  // 1e18 voxels
  for (int n = 0; n < 1000; ++n) {
    const Vec3 x = 0.1 * Vec3(n % 10 - 5, n / 10 % 10 - 5, n / 100 - 5) + Vec3::Constant(0.003);
    const double inside = x.minCoeff(), outside = x.cwiseMin(0.0).norm();
    const double exact = std::clamp(outside > 0 ? outside : -inside, -5 * voxel, 5 * voxel);
    CHECK(distance(x) == Approx(exact).margin(0.5 * voxel));  // trilinear at edges
  }
  CHECK(distance.block_count() < 5000);
  CHECK(distance(Vec3(5e3, 5e3, 5e3)) == Approx(-5 * voxel));
  CHECK(distance(Vec3(-1e12, 0, 0)) == 5 * voxel);
}

TEST_CASE("distances do not depend on the order in which places are asked for") {
  const SampledMesh one(sphere(Vec3(0.1, 0.2, 0.3), 0.3, 3), 0.02, 5),
      two(sphere(Vec3(0.1, 0.2, 0.3), 0.3, 3), 0.02, 5);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i)
    points.push_back(Vec3(0.1, 0.2, 0.3) + 0.4 * Vec3(std::sin(1.3 * i), std::sin(2.1 * i), std::sin(0.7 * i)));
  std::vector<double> forth;
  for (const Vec3& x : points) forth.push_back(one(x));
  std::size_t different = 0;
  for (std::size_t i = points.size(); i-- > 0;) different += two(points[i]) != forth[i];
  CHECK(different == 0);
}

}  // namespace sampled_mesh_tests
