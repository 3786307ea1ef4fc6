// Contact surfaces: closed, oriented outwards, on the shape.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include <cmath>

#include "base/error.h"
#include "base/shape_spec.h"
#include "geometry/shapes/closed_surface.h"
#include "solid/body/mass_properties.h"
#include "unit/solid/surface_checks.h"

namespace closed_surface_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

const std::vector<std::string> primitives{"box", "sphere", "cylinder", "capsule"};

template <int Dim>
SurfaceMesh surface_of(const ShapeSpec& spec, double cell_size) {
  return contact_surface<Dim>(spec, {cell_size, nullptr}, Vec<Dim>::Constant(-2), Vec<Dim>::Constant(2));
}

// Signed volume: negative for a surface oriented inwards.
template <int Dim>
double volume_of(const SurfaceMesh& mesh) {
  return mass_of_surface<Dim>(mesh, 1).volume;
}

// Largest distance from the shape's surface: of the corners, and of the middles of triangles or segments.
struct Distances {
  double corners = 0, middles = 0;
};

template <int Dim>
Distances distances(const SurfaceMesh& mesh, const ShapeSpec& spec, double cell_size) {
  const auto field = make_shape<Dim>(spec, {cell_size, nullptr});
  Distances d;
  const auto at = [&](const Vec3& x) { return std::abs((*field)(truncate<Dim>(x))); };
  for (const Vec3& p : mesh.points) d.corners = std::max(d.corners, at(p));
  const auto point = [&](int i) { return mesh.points[std::size_t(i)]; };
  for (const auto& [i, j, k] : mesh.triangles)
    d.middles = std::max(d.middles, at((point(i) + point(j) + point(k)) / 3));
  for (const auto& [i, j] : mesh.segments) d.middles = std::max(d.middles, at((point(i) + point(j)) / 2));
  return d;
}

// Corners lie on the surface up to round-off, middles within the promised 0.05 cells.
template <int Dim>
void check_primitive(ShapeSpec spec, double cell_size) {
  const MassProperties exact =
      mass_properties<Dim>(spec, 1, {cell_size, nullptr}, Vec<Dim>::Constant(-2), Vec<Dim>::Constant(2));
  const SurfaceMesh mesh = surface_of<Dim>(spec, cell_size);
  CHECK(is_closed(mesh));
  const Distances d = distances<Dim>(mesh, spec, cell_size);
  CHECK(self_intersections(mesh) == 0);
  CHECK(d.corners < 1e-13);
  CHECK(d.middles <= 0.05 * cell_size + 1e-13);
  // A surface at most c inside a shape of smallest radius r lacks about Dim c/r of its volume.
  const double missing = Dim * 0.05 * cell_size / (spec.radius * spec.transform.scale);
  const double volume = volume_of<Dim>(mesh);
  CHECK(volume <= exact.volume * (1 + 1e-13));
  CHECK(volume > exact.volume * (1 - missing - 1e-13));
  spec.invert = true;
  const SurfaceMesh inside_out = surface_of<Dim>(spec, cell_size);
  CHECK(is_closed(inside_out));
  CHECK(inside_out.points == mesh.points);
}

}  // namespace

TEST_CASE("primitives have closed surfaces within a twentieth of a cell of theirs") {
  for (const std::string& kind : primitives) {
    ShapeSpec s = solid_shape(kind);
    for (const double cell_size : {0.2, 0.05, 0.03}) {
      INFO(kind << ", cells of " << cell_size);
      s.transform = skewed_transform(3);
      check_primitive<3>(s, cell_size);
      s.transform = skewed_transform(2);
      check_primitive<2>(s, cell_size);
    }
  }
}

TEST_CASE("a capsule of no length is a ball") {
  ShapeSpec s = solid_shape("capsule");
  s.to = s.from;
  check_primitive<3>(s, 0.05);
  check_primitive<2>(s, 0.05);
}

TEST_CASE("an inverted shape faces the other way") {
  ShapeSpec s = solid_shape("capsule");
  s.invert = true;
  const SurfaceMesh mesh = surface_of<3>(s, 0.1);
  const auto [i, j, k] = mesh.triangles[0];
  const auto p = [&](int n) { return mesh.points[std::size_t(n)]; };
  const Vec3 normal = (p(j) - p(i)).cross(p(k) - p(i)), middle = (p(i) + p(j) + p(k)) / 3;
  CHECK(normal.dot(middle - 0.5 * (s.from + s.to)) < 0);
}

TEST_CASE("boxes are exact and large bodies have no more points than stated") {
  const SurfaceMesh box = surface_of<3>(solid_shape("box"), 0.1);
  CHECK(box.points.size() == 8);
  CHECK(box.triangles.size() == 12);
  CHECK(surface_of<2>(solid_shape("box"), 0.1).segments.size() == 4);
  CHECK(surface_of<2>(solid_shape("cylinder"), 0.1).segments.size() == 4);
  const double tiny = 1e-5;
  CHECK(surface_of<3>(solid_shape("sphere"), tiny).points.size() == 642);
  CHECK(surface_of<3>(solid_shape("cylinder"), tiny).points.size() == 2 * 128 + 2);
  CHECK(surface_of<3>(solid_shape("capsule"), tiny).points.size() == 48 * 24 + 2);
  CHECK(surface_of<2>(solid_shape("sphere"), tiny).points.size() == 256);
  CHECK(surface_of<2>(solid_shape("capsule"), tiny).points.size() == 258);
}

TEST_CASE("bounds on points set in beyond the stated sizes") {
  ShapeSpec s = solid_shape("sphere");
  const double cell = s.radius / 11;
  CHECK(distances<3>(surface_of<3>(s, cell), s, cell).middles <= 0.05 * cell);
  s = solid_shape("cylinder");
  CHECK(distances<3>(surface_of<3>(s, s.radius / 160), s, 1).middles <= 0.05 * s.radius / 160);
  s = solid_shape("capsule");
  CHECK(distances<3>(surface_of<3>(s, s.radius / 11), s, 1).middles <= 0.05 * s.radius / 11);
}

TEST_CASE("a plane is a block whose face covers the domain") {
  ShapeSpec s = solid_shape("plane");
  s.transform = skewed_transform(3);
  for (const bool inverted : {false, true}) {
    s.invert = inverted;
    const SurfaceMesh mesh = surface_of<3>(s, 0.1);
    CHECK(is_closed(mesh));
    CHECK(mesh.triangles.size() == 12);
    CHECK(volume_of<3>(mesh) > 0);
    const auto field = make_shape<3>(s, {0.1, nullptr});
    int on_face = 0;
    for (const Vec3& p : mesh.points) {
      on_face += std::abs((*field)(p)) < 1e-12;
      CHECK((*field)(p) < 1e-12);
      CHECK(p.norm() > 2 * std::sqrt(3.0));  // beyond the domain
    }
    CHECK(on_face == 4);
  }
  s = solid_shape("plane");
  const SurfaceMesh line = surface_of<2>(s, 0.1);
  CHECK(is_closed(line));
  CHECK(volume_of<2>(line) > 0);
  CHECK(distances<2>(line, s, 0.1).corners > 1);
}

// Dual contouring averages the points on a cell's edges, so vertices lie less than h^2/(2 r) inside the surface.
TEST_CASE("expressions are contoured, and cut off where they leave the domain") {
  ShapeSpec s = solid_shape("expression");
  s.phi = "y-0.1*sin(3*x)";
  for (const bool inverted : {false, true}) {
    s.invert = inverted;
    const SurfaceMesh floor = surface_of<3>(s, 0.1), line = surface_of<2>(s, 0.1);
    CHECK(is_closed(floor));
    CHECK(is_closed(line));
    const double sign = inverted ? -1 : 1;
    CHECK(sign * volume_of<3>(floor) == Approx(4.4 * 4.4 * 2.2).epsilon(0.02));
    CHECK(sign * volume_of<2>(line) == Approx(4.4 * 2.2).epsilon(0.02));
  }
  s.phi = "sqrt((x-0.1)^2+(y+0.2)^2+z^2)-0.25";
  s.invert = false;
  const SurfaceMesh ball = surface_of<3>(s, 0.05);
  CHECK(is_closed(ball));
  CHECK(distances<3>(ball, s, 0.05).corners < 0.05 * 0.05 / (2 * 0.25));
}

// Two overlapping balls, a thin shell, and a block with a hole: creases and narrow gaps.
TEST_CASE("contours do not go through themselves") {
  ShapeSpec s = solid_shape("expression");
  for (const char* phi :
       {"min(sqrt((x-0.3)^2+y*y+z*z)-0.29,sqrt((x+0.3)^2+y*y+z*z)-0.29)",
        "max(sqrt(x*x+y*y+z*z)-0.5,0.4-sqrt(x*x+y*y+z*z))", "max(abs(x)+abs(y)+abs(z)-0.5,-(x*x+y*y-0.04))"}) {
    INFO(phi);
    s.phi = phi;
    for (const TransformSpec& transform : {TransformSpec{}, skewed_transform(3)}) {
      s.transform = transform;
      const SurfaceMesh mesh = surface_of<3>(s, 0.08);
      CHECK(is_closed(mesh));
      CHECK(self_intersections(mesh) == 0);
    }
  }
}

TEST_CASE("impossible shapes have no surface") {
  ShapeSpec s = solid_shape("sphere");
  s.radius = 0;
  CHECK_THROWS_AS(surface_of<3>(s, 0.1), Error);
  s = solid_shape("plane");
  s.normal = Vec3::Zero();
  CHECK_THROWS_AS(surface_of<3>(s, 0.1), Error);
  CHECK_THROWS_AS(surface_of<2>(solid_shape("mesh"), 0.1), Error);
  CHECK_THROWS_AS(surface_of<3>(solid_shape("wedge"), 0.1), Error);
}

}  // namespace closed_surface_tests
