// Values of a surface near a point: means, normals, distances.
#include <catch2/catch.hpp>

#include "levelset/surface_distance.h"

namespace surface_mean_tests {
using namespace seiche;

namespace {

// Outline of the box from (x0, -t/2) to (x1, t/2), with its long sides in n pieces.
SurfaceMesh strip(double x0, double x1, double t, int n) {
  SurfaceMesh m;
  for (const double side : {-0.5, 0.5})
    for (int i = 0; i <= n; ++i) {
      const double share = double(side < 0 ? i : n - i) / n;
      m.points.push_back({x0 + (x1 - x0) * share, side * t, 0});
    }
  const int count = int(m.points.size());
  for (int i = 0; i < count; ++i) m.segments.push_back({i, (i + 1) % count});
  return m;
}

std::vector<Vec<2>> flat(const SurfaceMesh& m) {
  std::vector<Vec<2>> points;
  for (const Vec3& x : m.points) points.push_back(x.head<2>());
  return points;
}

}  // namespace

TEST_CASE("the mean of a surface around a point is of all points near it, however long its facets are") {
  Geometry<2> g;
  g.lower = {-1, -1};
  g.h = 0.1;
  g.cells = {20, 20};
  const Layout<2> layout(g, g.box(), 3);
  for (const int n : {1, 7, 80}) {
    const SurfaceMesh m = strip(-0.8, 0.8, 0.04, n);
    const std::vector<Vec<2>> points = flat(m);
    const SurfaceDistance<2> surface(layout, m, points);
    const Vec<2> x(0.05, 0.03);
    double sum = 0;
    Vec<2> mean = Vec<2>::Zero();
    std::vector<bool> seen(points.size());
    for (const auto& [point, weight] : surface.mean_around(x, 0.15)) {
      CHECK(weight >= 0);
      sum += weight;
      mean += weight * points[std::size_t(point)];
      seen[std::size_t(point)] = weight > 0;
    }
    CHECK(sum == Approx(1).epsilon(1e-14));
    // Along the strip the mean is x, up to the quadrature error; across it lies between both sides.
    CHECK(mean[0] == Approx(x[0]).margin(0.01));
    CHECK(std::abs(mean[1]) < 0.02);
    for (std::size_t k = 0; k < points.size(); ++k)
      if ((points[k] - x).norm() < 0.14) CHECK(seen[k]);
    CHECK(surface.mean_around({0.05, 0.9}, 0.15).empty());
  }
}

// The box of a long oblique facet reaches far beyond the facet itself.
TEST_CASE("a surface has a nearest point, a normal and a distance within two cells of it only") {
  Geometry<2> g;
  g.lower = {-1, -1};
  g.h = 0.1;
  g.cells = {20, 20};
  const Layout<2> layout(g, g.box(), 3);
  SurfaceMesh m;
  m.points = {{-0.6, -0.6, 0}, {0.6, -0.6, 0}, {-0.6, 0.6, 0}};
  m.segments = {{0, 1}, {1, 2}, {2, 0}};
  const std::vector<Vec<2>> points = flat(m);
  const SurfaceDistance<2> surface(layout, m, points);
  const Vec<2> normal = Vec<2>(1, 1).normalized();
  for (const double d : {-0.25, -0.15, 0.15, 0.19, 0.21, 0.5}) {  // from the oblique side
    INFO(d);
    const Vec<2> x = d * normal;
    const bool is_near = std::abs(d) <= 0.2;
    SurfacePoint<2> point;
    CHECK(surface.nearest(x, point) == is_near);
    CHECK(surface.nearest_weights(x).empty() == !is_near);
    CHECK((surface.normal_near(x) - (is_near ? normal : Vec<2>::Zero().eval())).norm() <= 1e-15);
    CHECK(surface.distance(x) == Approx(is_near ? d : 0.2).epsilon(1e-14));
  }
}

}  // namespace surface_mean_tests
