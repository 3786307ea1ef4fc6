#include "geometry/mesh/clipped_volume.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/shapes/shapes.h"

namespace clipped_volume_tests {
using namespace seiche;

namespace {

template <int Dim>
SurfaceMesh box_surface() {
  SurfaceMesh m;
  if (Dim == 2) {
    m.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
    m.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    return m;
  }
  for (int k = 0; k < 8; ++k) m.points.emplace_back(2 * (k & 1), (k >> 1) & 1, k >> 2);
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

SurfaceMesh turned(SurfaceMesh m) {
  Eigen::Matrix3d r = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& x : m.points) x = r * x;
  return m;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the part of a box in a box has its volume", "", ((int Dim), Dim), 2, 3) {
  const SurfaceMesh m = box_surface<Dim>();
  CHECK(clipped_volume<Dim>(m, Vec3(-9, -9, -9), Vec3(9, 9, 9)) == Approx(2));
  CHECK(clipped_volume<Dim>(m, Vec3(0.5, -9, -9), Vec3(9, 9, 9)) == Approx(1.5));
  CHECK(clipped_volume<Dim>(m, Vec3(0.5, 0.25, 0), Vec3(1.5, 0.5, 1)) == Approx(0.25));
  CHECK(clipped_volume<Dim>(m, Vec3(-5, 0, 0), Vec3(-1, 1, 1)) == Approx(0).margin(1e-14));
  CHECK(clipped_volume<Dim>(m, Vec3(0, 0, 0), Vec3(2, 1, 1)) == Approx(2));
}

TEST_CASE("parts of a turned box add up to it") {
  const SurfaceMesh m = turned(box_surface<3>());
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner(-4 + 4.3 * (k & 1), -4 + 4.2 * ((k >> 1) & 1), -4 + 4.1 * (k >> 2));
    sum += clipped_volume<3>(m, corner, {(k & 1) ? 4. : 0.3, (k & 2) ? 4. : 0.2, (k & 4) ? 4. : 0.1});
  }
  CHECK(sum == Approx(2).epsilon(1e-12));
}

}  // namespace clipped_volume_tests
