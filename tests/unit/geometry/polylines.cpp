// Closed polylines: their files, distances and what is refused.
#include "geometry/mesh/polyline.h"

#include <catch2/catch.hpp>

#include "base/error.h"
#include "base/shape_spec.h"
#include "geometry/shapes/closed_surface.h"
#include "geometry/shapes/shapes.h"
#include "unit/geometry/mesh_files.h"

namespace polylines_tests {
using namespace seiche;
using namespace seiche::mesh_files;
using Catch::Matchers::Contains;

namespace {

const std::string square = "x, y\n0, 0\n1, 0\n1, 1\n0, 1\n";

SurfaceMesh read(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  return read_closed_polylines(folder.write(name, text), notes);
}

std::string fault_of(const std::string& name, const std::string& text) {
  try {
    read(name, text);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  return "";
}

double area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b] : mesh.segments) {
    const Vec3 &p = mesh.points[std::size_t(a)], &q = mesh.points[std::size_t(b)];
    sum += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  return sum;
}

// Distance from the unit square, negative inside.
double exact(const Vec3& x) {
  const Vec3 d = (x - Vec3(0.5, 0.5, 0)).cwiseAbs() - Vec3(0.5, 0.5, 0);
  return std::max(d[0], d[1]) <= 0 ? std::max(d[0], d[1]) : std::hypot(std::max(d[0], 0.0), std::max(d[1], 0.0));
}

}  // namespace

TEST_CASE("polylines: rows and lines in any order and direction give the same surface") {
  for (const std::string& text : {square, std::string("0;0\n0;1\n1;1\n1;0\n0;0\n"),
                                  std::string("# a\n0 0\n1 0\n1 1\n0 1"), "\xEF\xBB\xBF" + square,
                                  std::string("\xEF\xBB\xBF"
                                              "0,0\n1,0\n1,1\n0,1\n")}) {
    const SurfaceMesh mesh = read("a.csv", text);
    CHECK(mesh.points.size() == 4);
    CHECK(mesh.segments.size() == 4);
    CHECK(area(mesh) == 1);
  }
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  CHECK(area(read("a.obj", points + "l 1 2 3 4 1\n")) == 1);
  CHECK(area(read("a.obj", points + "l 1 4\nl 3 4\nl 1 2\nl 3 2\n")) == 1);
  CHECK(area(read("a.obj", "v 9 9 0\n" + points + "v 0 0 0\nl 2 5\nl 4 5\nl 6 3\nl 4 3\n")) == 1);  // a point twice
}

TEST_CASE("polylines: those within others bound holes, and what lies in holes is full again") {
  std::string text = square;
  for (const double half : {0.3, 0.1})
    for (const auto& [x, y] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
      text += fmt::format("{}{} {}\n", x == -1 && y == -1 ? "\n" : "", 0.5 + half * x, 0.5 + half * y);
  const SurfaceMesh mesh = read("holes.txt", text);
  CHECK(mesh.segments.size() == 12);
  CHECK(area(mesh) == Approx(1 - 0.36 + 0.04).epsilon(1e-14));
  const mesh::PolylineDistance distance(mesh);
  CHECK(distance({0.5, 0.5, 0}) == Approx(-0.1).epsilon(1e-14));
  CHECK(distance({0.5, 0.3, 0}) == Approx(0.1).epsilon(1e-14));
  CHECK(distance({0.5, 0.1, 0}) == Approx(-0.1).epsilon(1e-14));
  CHECK(distance({0.5, -3, 0}) == Approx(3).epsilon(1e-14));
}

TEST_CASE("polylines: distances are exact, level with corners too") {
  const mesh::PolylineDistance distance(read("a.csv", square));
  for (double x = -1; x <= 2; x += 0.125)
    for (double y = -1; y <= 2; y += 0.125) {
      INFO(x << ", " << y);
      CHECK(distance({x, y, 0}) == Approx(exact({x, y, 0})).margin(1e-15));
    }
}

TEST_CASE("polylines: a shape of one is scaled, turned, moved and inverted, and is its own contact surface") {
  const TemporaryFolder folder;
  ShapeSpec spec;
  spec.kind = "mesh";
  spec.file = folder.write("a.csv", square);
  spec.transform = {2, {{0, 0, 1}, 90}, {3, 0, 0}};  // 1 to 3, 0 to 2
  CHECK((*make_shape<2>(spec, {0.1, nullptr}))({2, 1.5}) == Approx(-0.5).epsilon(1e-14));
  CHECK((*make_shape<2>(spec, {0.1, nullptr}))({0, 1}) == Approx(1).epsilon(1e-14));
  CHECK(area(contact_surface<2>(spec, {0.1, nullptr}, {0, 0}, {1, 1})) == Approx(4).epsilon(1e-14));
  spec.invert = true;
  CHECK((*make_shape<2>(spec, {0.1, nullptr}))({2, 1.5}) == Approx(0.5).epsilon(1e-14));
  CHECK(area(contact_surface<2>(spec, {0.1, nullptr}, {0, 0}, {1, 1})) == Approx(-4).epsilon(1e-14));
}

TEST_CASE("polylines: what is no closed outline is refused with its place") {
  CHECK_THAT(fault_of("a.csv", "0,0\n1,1\n1,0\n0,1\n"), Contains("crosses or touches itself") && Contains("a.csv"));
  CHECK_THAT(fault_of("a.csv", square + "\n1,0.5\n2,0\n2,1\n"), Contains("crosses or touches itself"));
  CHECK_THAT(fault_of("a.csv", "0,0\n2,0\n1,0\n1,1\n"), Contains("crosses or touches itself"));  // folds back
  CHECK_THAT(fault_of("a.csv", square + "\n0,0\n-1,0\n-1,-1\n"), Contains("more than two lines meet at 1 points"));
  CHECK_THAT(fault_of("a.csv", "0,0\n1,0\n"), Contains("a.csv:2") && Contains("takes 3 or more"));
  CHECK_THAT(fault_of("a.csv", "0,0\n1,0,2\n"), Contains("a.csv:2") && Contains("has two, x and y"));
  CHECK_THAT(fault_of("a.csv", "0,0\n1,one\n"), Contains("a.csv:2") && Contains("'one' is not a number"));
  CHECK_THAT(fault_of("a.csv", "0,0\n1,nan\n1,1\n"), Contains("is not a number"));
  CHECK_THAT(fault_of("a.csv", "x,y\n"), Contains("holds no points"));
  CHECK_THAT(fault_of("a.csv", ""), Contains("is empty"));
  CHECK_THAT(fault_of("a.csv", "0,0\n0,0\n0,0\n0,0\n"), Contains("fewer than 3 lines"));
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  CHECK_THAT(fault_of("a.obj", points + "v 0 1 0\nl 1 2 3 4\n"),
             Contains("not closed, it has 2 open ends, the first at (0, 0)"));
  CHECK_THAT(fault_of("a.obj", points + "f 1 2 3\n"), Contains("holds no lines (l), but faces (f)"));
  CHECK_THAT(fault_of("a.obj", points + "v 0 1 0.5\nl 1 2 3 4 1\n"), Contains("leave the plane z = 0"));
  CHECK_THAT(fault_of("a.obj", points + "l 1 2 3 7\n"), Contains("a.obj:4: the line uses point 7"));
  CHECK_THAT(fault_of("a.obj", points + "l 1\n"), Contains("a.obj:4"));
  CHECK_THAT(fault_of("a.csv", "x, y\nmm, mm\n0, 0\n"), Contains("a.csv:2: 'mm' is not a number"));
  CHECK_THAT(fault_of("a.csv", "0.1mm,0.2mm\n0, 0\n"), Contains("a.csv:1: '0.1mm' is not a number"));
}

TEST_CASE("polylines: crossings of very many lines are found soon") {
  std::string text;
  constexpr int count = 20000;
  for (int n = 0; n < count; ++n) {
    const double angle = 2 * M_PI * n / count, r = 1 + 0.1 * std::sin(400 * angle);
    text += fmt::format("{} {}\n", r * std::cos(angle), r * std::sin(angle));
  }
  CHECK(area(read("gear.txt", text)) == Approx(M_PI * 1.005).epsilon(1e-3));
}

TEST_CASE("polylines: a polygon of a scene is its outline in either direction, moved and exact") {
  ShapeSpec spec;
  spec.kind = "polygon";
  spec.where = "scene.toml:4";
  spec.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  spec.transform.translate = Vec3(2, 0, 0);
  for (const bool turned : {false, true}) {
    if (turned) std::reverse(spec.points.begin(), spec.points.end());
    const auto shape = make_shape<2>(spec, {0.1, nullptr});
    for (const Vec3& x : {Vec3(0.3, 0.4, 0), Vec3(-0.5, 2, 0), Vec3(0.9, 0.2, 0)})
      CHECK((*shape)({x[0] + 2, x[1]}) == Approx(exact(x)).epsilon(1e-14));
    CHECK(area(contact_surface<2>(spec, {0.1, nullptr}, {0, 0}, {4, 4})) == Approx(1));
  }
}

TEST_CASE("polylines: a polygon that crosses itself or meets itself in a corner is refused with the scene's line") {
  ShapeSpec spec;
  spec.kind = "polygon";
  spec.where = "scene.toml:4";
  spec.points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK_THROWS_WITH(make_shape<2>(spec, {0.1, nullptr}),
                    Contains("scene.toml:4") && Contains("the outline crosses or touches itself"));
  spec.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  CHECK_THROWS_WITH(make_shape<2>(spec, {0.1, nullptr}),
                    Contains("scene.toml:4") && Contains("more than two lines meet"));
}

}  // namespace polylines_tests
