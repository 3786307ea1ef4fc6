// Meshes as shapes: distances against closed forms, transforms, cavities, messages.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/shape_spec.h"
#include "geometry/mesh/distance.h"
#include "geometry/shapes/shapes.h"
#include "grid/serial.h"
#include "unit/geometry/mesh_files.h"

namespace mesh_shapes_tests {
using namespace seiche;
using namespace seiche::mesh_files;

namespace {

constexpr double pi = 3.14159265358979323846;

ShapeSpec mesh_spec(const std::filesystem::path& file) {
  ShapeSpec spec;
  spec.kind = "mesh";
  spec.file = file;
  spec.where = "scene.toml:3";
  return spec;
}

}  // namespace

TEST_CASE("the distance to a triangle is that to its face, edges or corners") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  const double round_off = 1e-15;  // of lengths about 1
  CHECK(mesh::distance_to_triangle(Vec3(0.2, 0.3, -0.5), a, b, c) == Approx(0.5).margin(round_off));
  CHECK(mesh::distance_to_triangle(Vec3(0.5, -0.3, 0.4), a, b, c) == Approx(0.5).margin(round_off));
  CHECK(mesh::distance_to_triangle(Vec3(1, 1, 0), a, b, c) == Approx(std::sqrt(0.5)).margin(round_off));
  CHECK(mesh::distance_to_triangle(Vec3(3, -1, 2), a, b, c) == Approx(3).margin(4 * round_off));
  CHECK(mesh::distance_to_triangle(Vec3(0.5, 0.5, 0), a, b, b) == Approx(0.5).margin(round_off));  // no area
}

TEST_CASE("the nearest of many triangles is the nearest of all one by one") {
  const SurfaceMesh ball = sphere(Vec3(0.1, 0.2, 0.3), 0.4, 3);
  const mesh::NearestTriangle nearest(ball);
  for (int i = 0; i < 100; ++i) {
    const Vec3 x(std::sin(1.3 * i), std::sin(2.1 * i), std::sin(0.7 * i));
    double least = 10;
    for (const auto& t : ball.triangles) {
      least = std::min(least, mesh::distance_to_triangle(x, ball.points[t[0]], ball.points[t[1]], ball.points[t[2]]));
    }
    CHECK(nearest.distance(x, 10) == least);
    CHECK(nearest.distance(x, least / 2) == least / 2);
  }
}

TEST_CASE("the distance to a sphere of triangles converges to the sphere's with the square of their size") {
  const TemporaryFolder folder;
  const Vec3 center(0.513, 0.487, 0.519);
  const double radius = 0.3;
  double previous = 0;
  for (const int refinement : {3, 4, 5}) {
    const auto file = folder.write("ball.ply", binary_ply(sphere(center, radius, refinement), "little"));
    const double h = 0.8 * std::pow(0.5, refinement);  // cells about the size of the triangles
    const auto phi = make_shape<3>(mesh_spec(file), {h, nullptr});
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {  // spiral of directions, distances within four cells of the surface
      const double z = 1 - (2 * i + 1) / 4000.0, angle = 2.399963 * i, s = std::sqrt(1 - z * z);
      const double d = 2 * h * std::sin(0.37 * i);
      const Vec3 x = center + (radius + d) * Vec3(s * std::cos(angle), s * std::sin(angle), z);
      worst = std::max(worst, std::abs((*phi)(x)-d));
    }
    CAPTURE(refinement, worst);
    // Sagitta of edges of length 1.7 h / 1.6, plus trilinear interpolation 3 h^2 / 8 r' with r' >= radius - 2 h.
    CHECK(worst < h * h / radius);
    if (previous > 0) CHECK(worst < previous / 3);  // order 2 gives 4
    previous = worst;
  }
}

TEST_CASE("the distance to a cube of triangles is exact on the voxels within its band") {
  const TemporaryFolder folder;
  ShapeSpec spec = mesh_spec(folder.write("cube.stl", binary_stl(cube(), "exported")));
  const double h = 0.0625;
  const auto phi = make_shape<3>(spec, {h, nullptr});
  ShapeSpec exact_spec;
  exact_spec.kind = "box";
  exact_spec.upper = Vec3(1, 1, 1);
  const auto exact = make_shape<3>(exact_spec, {h, nullptr});
  for (int k = -3; k < 20; ++k) {
    for (int j = -3; j < 20; ++j) {
      for (int i = -3; i < 20; ++i) {
        const Vec3 x = h * Vec3(i, j, k);
        const double d = std::clamp((*exact)(x), -5 * h, 5 * h);
        if ((*phi)(x) != Approx(d).margin(1e-6)) FAIL(x.transpose() << ": " << (*phi)(x) << " for " << d);  // float
      }
    }
  }
}

TEST_CASE("a mesh shape follows its transform and inversion") {
  const TemporaryFolder folder;
  ShapeSpec spec = mesh_spec(folder.write("ball.obj", obj(sphere(Vec3(1, 0, 0), 0.5, 5))));
  spec.transform.scale = 0.5;
  spec.transform.rotate = {Vec3(0, 0, 1), 90};
  spec.transform.translate = Vec3(0.1, 0.2, 0.3);
  const Vec3 center(0.1, 0.7, 0.3);
  const ShapeOptions options{0.02, nullptr};
  // A chord of 1/32 of the circle lies 0.25 (2 pi / 128)^2 / 8 = 8e-5 inside; interpolation, h^2, adds 4e-4.
  CHECK((*make_shape<3>(spec, options))(Vec3(center + Vec3(0.28, 0, 0))) == Approx(0.03).margin(1e-3));
  const SurfaceMesh surface = shape_surface<3>(spec, options, Vec3(0, 0, 0), Vec3(1, 1, 1));
  CHECK(volume(surface) == Approx(4 * pi / 3 * std::pow(0.25, 3)).epsilon(0.01));
  spec.invert = true;
  CHECK((*make_shape<3>(spec, options))(Vec3(center + Vec3(0.28, 0, 0))) == Approx(-0.03).margin(1e-3));
  CHECK(volume(shape_surface<3>(spec, options, Vec3(0, 0, 0), Vec3(1, 1, 1))) == Approx(-volume(surface)));
}

TEST_CASE("a shell keeps its cavity, and a solid in the cavity is solid") {
  const TemporaryFolder folder;
  const Vec3 c(0.5, 0.5, 0.5);
  const SurfaceMesh nested = joined(joined(sphere(c, 0.45, 4), sphere(c, 0.3, 4)), sphere(c, 0.12, 4));
  std::vector<std::string> notes;
  const SurfaceMesh mesh = read_closed_mesh(folder.write("shell.ply", binary_ply(nested, "little")), notes);
  const double expected = 4 * pi / 3 * (std::pow(0.45, 3) - std::pow(0.3, 3) + std::pow(0.12, 3));
  CHECK(volume(mesh) == Approx(expected).epsilon(0.01));  // chords of 64 segments a circle
  CHECK(notes.size() == 1);
  const auto phi = make_shape<3>(mesh_spec(folder / "shell.ply"), {0.02, nullptr});
  for (const auto& [r, d] :
       {std::pair{0.47, 0.02}, {0.43, -0.02}, {0.32, -0.02}, {0.28, 0.02}, {0.14, 0.02}, {0.1, -0.02}}) {
    CHECK((*phi)(Vec3(c + r * Vec3(0.48, 0.6, 0.64))) == Approx(d).margin(2e-3));  // h^2 / r
  }
}

TEST_CASE("an error in a mesh names the scene's line and the mesh's line") {
  const TemporaryFolder folder;
  const auto file = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  CHECK_THROWS_WITH(make_shape<3>(mesh_spec(file), {0.1, nullptr}),
                    Catch::StartsWith("scene.toml:3: ") && Catch::Contains("bad.obj:2: "));
}

TEST_CASE("distances of a mesh are the same to the bit on one thread and on all") {
  const TemporaryFolder folder;
  const ShapeSpec spec = mesh_spec(folder.write("ball.ply", binary_ply(sphere(Vec3(0, 0, 0), 0.3, 4), "little")));
  const auto on_all = make_shape<3>(spec, {0.02, nullptr});
  std::unique_ptr<ShapeField<3>> on_one;
  run_serially([&] { on_one = make_shape<3>(spec, {0.02, nullptr}); });
  std::size_t different = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = 0.45 * Vec3(std::sin(1.3 * i), std::sin(2.1 * i), std::sin(0.7 * i));
    different += (*on_all)(x) != (*on_one)(x);
  }
  CHECK(different == 0);
}

}  // namespace mesh_shapes_tests
