// Shapes against closed forms, in 2D and 3D, transformed and inverted.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <set>

#include "base/error.h"
#include "base/shape_spec.h"
#include "geometry/shapes/shapes.h"

namespace shapes_tests {
using namespace seiche;

namespace {

constexpr double round_off = 1e-14;  // a few roundings of lengths about 1
constexpr double pi = 3.14159265358979323846;

template <int Dim>
std::vector<Vec<Dim>> random_points(int count) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  std::vector<Vec<Dim>> points(count);
  for (auto& p : points) {
    for (int a = 0; a < Dim; ++a) p[a] = uniform(generator);
  }
  return points;
}

ShapeSpec spec_of(const std::string& kind) {
  ShapeSpec spec;
  spec.kind = kind;
  spec.where = "scene.toml:14";
  spec.lower = Vec3(-0.5, -0.25, -0.75);
  spec.upper = Vec3(0.25, 0.5, 0.5);
  spec.center = Vec3(0.1, -0.2, 0.3);
  spec.from = Vec3(-0.3, 0.1, -0.2);
  spec.to = Vec3(0.4, 0.5, 0.3);
  spec.point = Vec3(0.1, 0.2, 0.3);
  spec.normal = Vec3(1, 2, 3);
  spec.radius = 0.35;
  return spec;
}

ShapeSpec expression_spec(const Formula& phi) {
  ShapeSpec spec = spec_of("expression");
  spec.phi = phi;
  return spec;
}

const ShapeOptions options{0.0625, nullptr};
const std::vector<std::string> primitives{"box", "sphere", "cylinder", "capsule", "plane"};

// Smallest distance to many points of the outline of the 2D shape; an upper bound that converges.
double distance_to_outline(const std::vector<Vec<2>>& corners, const Vec<2>& x) {
  double least = INFINITY;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2> a = corners[i], d = corners[(i + 1) % corners.size()] - a;
    const double t = std::clamp(d.dot(x - a) / d.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (a + t * d - x).norm());
  }
  return least;
}

template <int Dim>
void check_unit_gradient(const ShapeField<Dim>& phi) {
  const double e = 1e-6;
  int regular = 0;
  const auto points = random_points<Dim>(300);
  for (const auto& x : points) {
    Vec<Dim> gradient;
    for (int a = 0; a < Dim; ++a)
      gradient[a] = (phi(x + e * Vec<Dim>::Unit(a)) - phi(x - e * Vec<Dim>::Unit(a))) / (2 * e);
    regular += std::abs(gradient.norm() - 1) < 1e-4;  // second differences: e / distance to a kink
    CHECK(gradient.norm() < 1 + 1e-4);                // never more than a distance
  }
  CHECK(regular >= 297);  // the others lie on the medial axis, a set of measure zero
}

double signed_volume(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
  return sum;
}

double signed_area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (const auto& s : mesh.segments) {
    const Vec3 &p = mesh.points[s[0]], &q = mesh.points[s[1]];
    sum += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  return sum;
}

std::string refusal(const ShapeSpec& spec, const ShapeOptions& with = options) {
  try {
    make_shape<3>(spec, with);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a box is the exact distance to its faces, edges and corners") {
  const auto box = make_shape<3>(spec_of("box"), options);
  CHECK((*box)(Vec3(0, 0, 0)) == -0.25);  // the nearest face, x = 0.25; exact in binary
  CHECK((*box)(Vec3(0, 1.5, 0)) == 1.0);
  CHECK((*box)(Vec3(0.25, 0.1, 0.1)) == 0);  // on the face
  CHECK((*box)(Vec3(0.55, 0.9, 0)) == Approx(0.5).margin(round_off));
  CHECK((*box)(Vec3(0.45, 0.8, 1.1)) == Approx(0.7).margin(round_off));  // corner: 0.2, 0.3, 0.6
}

TEST_CASE("a sphere is the distance to its center less the radius") {
  const ShapeSpec spec = spec_of("sphere");
  for (const Vec3& x : random_points<3>(20)) {
    CHECK((*make_shape<3>(spec, options))(x) == Approx((x - spec.center).norm() - 0.35).margin(round_off));
    const Vec<2> flat = truncate<2>(x), center = truncate<2>(spec.center);
    CHECK((*make_shape<2>(spec, options))(flat) == Approx((flat - center).norm() - 0.35).margin(round_off));
  }
}

TEST_CASE("a plane has its inside where the normal points away from") {
  const ShapeSpec spec = spec_of("plane");
  for (const Vec3& x : random_points<3>(20)) {
    CHECK((*make_shape<3>(spec, options))(x) ==
          Approx(spec.normal.dot(x - spec.point) / std::sqrt(14.0)).margin(round_off));
  }
}

TEST_CASE("a cylinder is a capped one in 3D and a rectangle about its axis in 2D") {
  ShapeSpec spec = spec_of("cylinder");
  spec.from = Vec3(0, 0, -0.5);
  spec.to = Vec3(0, 0, 0.75);
  const auto upright = make_shape<3>(spec, options);
  CHECK((*upright)(Vec3(0.15, 0.2, 0)) == Approx(0.25 - 0.35).margin(round_off));
  CHECK((*upright)(Vec3(0.1, 0, 0.7)) == Approx(-0.05).margin(round_off));
  CHECK((*upright)(Vec3(0.39, 0.52, 1.15)) == Approx(0.5).margin(round_off));  // rim: 0.3 across, 0.4 along

  const ShapeSpec slanted = spec_of("cylinder");
  const Vec<2> a = truncate<2>(slanted.from), b = truncate<2>(slanted.to), d = (b - a).normalized(), n(-d[1], d[0]);
  const std::vector<Vec<2>> outline{a - 0.35 * n, b - 0.35 * n, b + 0.35 * n, a + 0.35 * n};
  const auto rectangle = make_shape<2>(slanted, options);
  for (const auto& x : random_points<2>(100)) {
    CHECK(std::abs((*rectangle)(x)) == Approx(distance_to_outline(outline, x)).margin(round_off));
    const bool inside = std::abs(n.dot(x - a)) < 0.35 && d.dot(x - a) > 0 && d.dot(x - b) < 0;
    CHECK(((*rectangle)(x) < 0) == inside);
  }
}

TEST_CASE("a capsule is the distance to its axis less the radius, a sphere if it has no length") {
  ShapeSpec spec = spec_of("capsule");
  const Vec3 d = (spec.to - spec.from).normalized();
  const Vec3 side = d.unitOrthogonal();
  const auto capsule = make_shape<3>(spec, options);
  CHECK((*capsule)(Vec3(spec.to + 0.5 * d)) == Approx(0.15).margin(round_off));
  CHECK((*capsule)(Vec3(spec.from - 0.1 * d)) == Approx(-0.25).margin(round_off));
  CHECK((*capsule)(Vec3((spec.from + spec.to) / 2 + 0.4 * side)) == Approx(0.05).margin(round_off));
  spec.to = spec.from;
  CHECK((*make_shape<3>(spec, options))(Vec3(spec.from + side)) == Approx(0.65).margin(round_off));
}

TEST_CASE("primitives change by one metre a metre, transformed and inverted too") {
  ShapeSpec spec = spec_of(GENERATE(from_range(primitives)));
  CAPTURE(spec.kind);
  check_unit_gradient<2>(*make_shape<2>(spec, options));
  check_unit_gradient<3>(*make_shape<3>(spec, options));
  spec.invert = true;
  spec.transform.scale = 0.5;
  spec.transform.rotate = {Vec3(1, -1, 2), 40};
  spec.transform.translate = Vec3(0.1, 0.2, -0.3);
  check_unit_gradient<2>(*make_shape<2>(spec, options));
  check_unit_gradient<3>(*make_shape<3>(spec, options));
}

TEST_CASE("a transform scales, then rotates, then translates the points of a shape") {
  ShapeSpec spec = spec_of(GENERATE(from_range(primitives)));
  CAPTURE(spec.kind);
  const auto plain3 = make_shape<3>(spec, options);
  const auto plain2 = make_shape<2>(spec, options);
  spec.transform.scale = 1.7;
  spec.transform.rotate = {Vec3(1, 2, -2), 33};
  spec.transform.translate = Vec3(0.3, -0.4, 0.5);
  const auto moved3 = make_shape<3>(spec, options);
  const auto moved2 = make_shape<2>(spec, options);
  const double angle = 33 * pi / 180;
  const Eigen::Matrix3d r3 = Eigen::AngleAxisd(angle, Vec3(1, 2, -2).normalized()).toRotationMatrix();
  const Eigen::Matrix2d r2 = Eigen::Rotation2Dd(angle).toRotationMatrix();
  for (const Vec3& x : random_points<3>(50)) {
    const Vec3 y3 = spec.transform.translate + r3 * (1.7 * x);
    CHECK((*moved3)(y3) == Approx(1.7 * (*plain3)(x)).margin(5 * round_off));
    const Vec<2> x2 = truncate<2>(x), y2 = truncate<2>(spec.transform.translate) + r2 * (1.7 * x2);
    CHECK((*moved2)(y2) == Approx(1.7 * (*plain2)(x2)).margin(5 * round_off));
  }
}

TEST_CASE("quarter turns are exact") {
  ShapeSpec spec = spec_of("plane");
  spec.point = Vec3(0, 0.5, 0);
  spec.normal = Vec3(0, 1, 0);
  const double quarters = GENERATE(-3, -2, -1, 1, 2, 3, 4, 5);
  spec.transform.rotate = {Vec3(0, 0, 1), 90 * quarters};
  const double c = std::round(std::cos(quarters * pi / 2)), s = std::round(std::sin(quarters * pi / 2));
  const auto phi = make_shape<2>(spec, options);
  for (const auto& x : random_points<2>(20)) CHECK((*phi)(x) == c * x[1] - s * x[0] - 0.5);
}

TEST_CASE("an inverted shape is its outside") {
  for (const std::string& kind : primitives) {
    ShapeSpec spec = spec_of(kind);
    const auto plain = make_shape<3>(spec, options);
    spec.invert = true;
    const auto inverted = make_shape<3>(spec, options);
    for (const Vec3& x : random_points<3>(20)) CHECK((*inverted)(x) == -(*plain)(x));
  }
}

TEST_CASE("a linear expression is an exact distance, whatever its slope and transform") {
  ShapeSpec spec = expression_spec("40*(x - 2*y + 2*z - 0.7)");
  const auto phi = make_shape<3>(spec, options);
  spec.transform.scale = 0.1;
  spec.transform.translate = Vec3(0.2, 0, 0);
  const auto moved = make_shape<3>(spec, options);
  for (const Vec3& x : random_points<3>(50)) {
    // Central differences over h/8 amplify round-off of phi, so about 100 round-offs.
    CHECK((*phi)(x) == Approx((x[0] - 2 * x[1] + 2 * x[2] - 0.7) / 3).margin(100 * round_off));
    CHECK((*moved)(x) == Approx((x[0] - 0.2 - 2 * x[1] + 2 * x[2] - 0.07) / 3).margin(1000 * round_off));
  }
}

TEST_CASE("an expression is a distance to first order near its zero") {
  ShapeSpec spec = expression_spec("x*x + y*y - 0.25");
  const auto phi = make_shape<2>(spec, options);
  for (const double d : {-0.02, -0.01, 0.0, 0.01, 0.02}) {
    const double r = 0.5 + d;
    CHECK((*phi)(Vec<2>(0.6 * r, 0.8 * r)) == Approx(d).margin(d * d / (2 * 0.5 * 0.9) + 1e-12));  // d^2 / 2r
  }
}

TEST_CASE("an expression stays finite and keeps its sign where its gradient vanishes") {
  ShapeSpec spec = expression_spec("x*x + y*y - 0.25");
  CHECK((*make_shape<2>(spec, options))(Vec<2>(0, 0)) < 0);
  CHECK(std::isfinite((*make_shape<2>(spec, options))(Vec<2>(0, 0))));
  spec = expression_spec("-1");
  CHECK((*make_shape<2>(spec, options))(Vec<2>(0.3, 0.4)) < 0);
  spec = expression_spec("1");
  CHECK((*make_shape<2>(spec, options))(Vec<2>(0.3, 0.4)) > 0);
  spec = expression_spec("0");
  CHECK((*make_shape<2>(spec, options))(Vec<2>(0.3, 0.4)) == 0);
}

TEST_CASE("shapes that make no sense are refused with place and remedy") {
  CHECK_THAT(refusal(spec_of("cone")),
             Catch::StartsWith("scene.toml:14: ") && Catch::Contains("'cone'") && Catch::Contains("capsule"));
  ShapeSpec spec = spec_of("box");
  spec.upper[1] = spec.lower[1];
  CHECK_THAT(refusal(spec), Catch::StartsWith("scene.toml:14: ") && Catch::Contains("lower"));
  spec = spec_of("sphere");
  spec.radius = 0;
  CHECK_THAT(refusal(spec), Catch::Contains("radius"));
  spec.radius = NAN;
  CHECK_THAT(refusal(spec), Catch::Contains("radius"));
  spec = spec_of("sphere");
  spec.center[0] = INFINITY;
  CHECK_THAT(refusal(spec), Catch::Contains("finite"));
  spec = spec_of("cylinder");
  spec.to = spec.from;
  CHECK_THAT(refusal(spec), Catch::Contains("length"));
  spec = spec_of("plane");
  spec.normal = Vec3(0, 0, 0);
  CHECK_THAT(refusal(spec), Catch::Contains("normal"));
  spec = spec_of("sphere");
  spec.transform.scale = -1;
  CHECK_THAT(refusal(spec), Catch::Contains("scale"));
  spec = spec_of("sphere");
  spec.transform.rotate = {Vec3(0, 0, 0), 10};
  CHECK_THAT(refusal(spec), Catch::Contains("axis"));
  spec = expression_spec("x +* y");
  CHECK_THAT(refusal(spec), Catch::StartsWith("scene.toml:14: ") && Catch::Contains("x +* y"));
}

TEST_CASE("an expression that is not a number somewhere says where") {
  ShapeSpec spec = expression_spec("sqrt(x)-0.3");
  const auto phi = make_shape<3>(spec, options);
  CHECK((*phi)(Vec3(0.5, 0, 0)) == Approx((std::sqrt(0.5) - 0.3) * 2 * std::sqrt(0.5)).epsilon(1e-3));
  CHECK_THROWS_WITH((*phi)(Vec3(-1, 0, 0)), Catch::Contains("is nan at (-1, 0, 0)"));
}

TEST_CASE("a mesh without a file is refused in 2D") {
  CHECK_THROWS_WITH(make_shape<2>(spec_of("mesh"), options), Catch::Contains("cannot be read"));
}

TEST_CASE("the table names every shape of the scene format once") {
  const auto names = shape_names();
  CHECK(std::set<std::string>(names.begin(), names.end()) ==
        std::set<std::string>{"box", "sphere", "cylinder", "capsule", "plane", "mesh", "polygon", "expression",
                              "level_set", "height_map"});
  CHECK(names.size() == 10);
}

TEST_CASE("the contour of a sphere faces outwards and encloses its volume to second order") {
  ShapeSpec spec = spec_of("sphere");
  double previous = 0;
  for (const double h : {0.1, 0.05, 0.025}) {
    const SurfaceMesh mesh = shape_surface<3>(spec, {h, nullptr}, Vec3(-1, -1, -1), Vec3(1, 1, 1));
    const double volume = 4.0 / 3 * pi * std::pow(0.35, 3);
    const double error = std::abs(signed_volume(mesh) / volume - 1);
    CHECK(error < 2 * h * h / (0.35 * 0.35));       // chords lie h^2 / 8r inside; vertex averaging doubles this
    if (previous > 0) CHECK(error < previous / 3);  // order 2 gives 4
    previous = error;
  }
}

TEST_CASE("the contour of a disc has its inside to the left and its area to second order") {
  ShapeSpec spec = spec_of("sphere");
  const double h = 0.02;
  const SurfaceMesh mesh = shape_surface<2>(spec, {h, nullptr}, Vec<2>(-1, -1), Vec<2>(1, 1));
  CHECK(signed_area(mesh) == Approx(pi * 0.35 * 0.35).epsilon(h * h / (0.35 * 0.35)));
  spec.invert = true;
  const SurfaceMesh inverted = shape_surface<2>(spec, {h, nullptr}, Vec<2>(-1, -1), Vec<2>(1, 1));
  CHECK(signed_area(inverted) == Approx(-signed_area(mesh)).epsilon(1e-12));
}

TEST_CASE("a polyline is closed: each point starts one segment and ends one, saddles too") {
  const ShapeSpec spec = expression_spec(
      GENERATE("(x-0.013)*(y+0.007)-0.001 + 10*max(0,x*x+y*y-0.3)", "0.001-x*y + 10*max(0,x*x+y*y-0.3)"));
  const SurfaceMesh mesh = shape_surface<2>(spec, {0.05, nullptr}, Vec<2>(-1, -1), Vec<2>(1, 1));
  std::vector<int> starts(mesh.points.size(), 0), ends(mesh.points.size(), 0);
  for (const auto& s : mesh.segments) ++starts[s[0]], ++ends[s[1]];
  CHECK(mesh.segments.size() > 40);
  CHECK(std::all_of(starts.begin(), starts.end(), [](int n) { return n == 1; }));
  CHECK(std::all_of(ends.begin(), ends.end(), [](int n) { return n == 1; }));
}

TEST_CASE("a surface that leaves the box is cut open, not capped") {
  const ShapeSpec spec = spec_of("plane");
  const SurfaceMesh mesh = shape_surface<3>(spec, {0.1, nullptr}, Vec3(-1, -1, -1), Vec3(1, 1, 1));
  CHECK(mesh.triangles.size() > 100);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.points[t[0]];
    const Vec3 normal = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a).normalized();
    CHECK(normal.dot(spec.normal.normalized()) == Approx(1).epsilon(1e-4));  // float points
  }
}

}  // namespace shapes_tests
