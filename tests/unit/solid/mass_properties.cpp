// Mass, centre and inertia against closed forms and sums over a fine grid.
#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/shape_spec.h"
#include "geometry/shapes/closed_surface.h"
#include "solid/body/mass_properties.h"
#include "unit/solid/surface_checks.h"

namespace mass_properties_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double round_off = 1e-13;  // a few roundings of lengths about 1
const ShapeOptions options{0.05, nullptr};
const std::vector<std::string> primitives{"box", "sphere", "cylinder", "capsule"};

template <int Dim>
MassProperties measure(const ShapeSpec& spec, double density = 1) {
  return mass_properties<Dim>(spec, density, options, Vec<Dim>::Constant(-2), Vec<Dim>::Constant(2));
}

// Integrals as sums over n^Dim cells of [-1.5, 1.5]^Dim; the fraction of a cell is taken from the distance at its
// centre.
template <int Dim>
MassProperties sum_over_grid(const ShapeSpec& spec, double density, int n) {
  const auto field = make_shape<Dim>(spec, options);
  const double h = 3.0 / n;
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < (Dim == 2 ? n * n : n * n * n); ++i) {
    Vec3 x(i % n, i / n % n, i / n / n);
    x = (x + Vec3::Constant(0.5)) * h - Vec3::Constant(1.5);
    if (Dim == 2) x[2] = 0;
    const double share = std::clamp(0.5 - (*field)(truncate<Dim>(x)) / h, 0.0, 1.0) * std::pow(h, Dim);
    volume += share;
    first += share * x;
    second += share * x * x.transpose();
  }
  const Vec3 c = first / volume;
  second -= volume * c * c.transpose();
  MassProperties m{density * volume, volume, c, density * (second.trace() * Eigen::Matrix3d::Identity() - second)};
  if (Dim == 2) m.inertia.topLeftCorner<2, 2>().setZero();
  return m;
}

void check_alike(const MassProperties& a, const MassProperties& b, double tolerance) {
  CHECK(std::abs(a.mass - b.mass) < tolerance * b.mass);
  CHECK(std::abs(a.volume - b.volume) < tolerance * b.volume);
  CHECK((a.center - b.center).norm() < tolerance);
  CHECK((a.inertia - b.inertia).norm() < tolerance * b.inertia.norm());
}

template <int Dim>
std::string fault(const ShapeSpec& spec) {
  try {
    measure<Dim>(spec);
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::bad_input);
    return e.what();
  }
  return "accepted";
}

Eigen::Matrix3d diagonal(double a, double b, double c) {
  return Vec3(a, b, c).asDiagonal();
}

}  // namespace

TEST_CASE("textbook inertias in 3D") {
  const double density = 700;
  ShapeSpec s = solid_shape("box");
  s.lower = Vec3(1, 2, 3);
  s.upper = Vec3(1.1, 2.2, 3.4);
  const double m = density * 0.1 * 0.2 * 0.4;
  check_alike(measure<3>(s, density),
              {m, 0.008, Vec3(1.05, 2.1, 3.2), m / 12 * diagonal(0.04 + 0.16, 0.01 + 0.16, 0.01 + 0.04)}, round_off);
  s = solid_shape("sphere");
  const double ball = 4.0 / 3 * pi * std::pow(0.25, 3);
  check_alike(measure<3>(s, density),
              {density * ball, ball, s.center, 0.4 * density * ball * 0.0625 * diagonal(1, 1, 1)}, round_off);
  s = solid_shape("cylinder");
  s.from = Vec3(0, 0, 0);
  s.to = Vec3(0, 0, 0.5);
  const double tube = pi * 0.0625 * 0.5, across = density * tube * (3 * 0.0625 + 0.25) / 12;
  check_alike(measure<3>(s, density),
              {density * tube, tube, Vec3(0, 0, 0.25), diagonal(across, across, density * tube * 0.0625 / 2)},
              round_off);
  // A capsule of zero length is a ball.
  s.kind = "capsule";
  s.to = s.from;
  check_alike(measure<3>(s, 1), {ball, ball, s.from, 0.4 * ball * 0.0625 * diagonal(1, 1, 1)}, round_off);
}

TEST_CASE("textbook inertias in 2D, a metre deep") {
  ShapeSpec s = solid_shape("box");
  s.lower = Vec3(0, 0, 0);
  s.upper = Vec3(0.3, 0.4, 0);
  check_alike(measure<2>(s, 10), {1.2, 0.12, Vec3(0.15, 0.2, 0), diagonal(0, 0, 1.2 * 0.25 / 12)}, round_off);
  s = solid_shape("sphere");
  const double disc = pi * 0.0625;
  check_alike(measure<2>(s, 10), {10 * disc, disc, Vec3(0.1, -0.2, 0), diagonal(0, 0, 10 * disc * 0.0625 / 2)},
              round_off);
  s = solid_shape("cylinder");  // in 2D a rectangle
  const double length = std::hypot(0.7, 0.4), area = length * 0.5;
  check_alike(measure<2>(s, 1), {area, area, Vec3(0.05, 0.3, 0), diagonal(0, 0, area * (length * length + 0.25) / 12)},
              round_off);
}

// The smoothed boundary of the sums adds about (h/r)^2 to an inertia, relatively: 1.4e-3 in 3D, 9e-5 in 2D.
TEST_CASE("primitives scaled, turned and moved have the moments of their inside") {
  for (const std::string& kind : primitives) {
    INFO(kind);
    ShapeSpec s = solid_shape(kind);
    s.transform = skewed_transform(3);
    check_alike(measure<3>(s, 3), sum_over_grid<3>(s, 3, 250), 1.5e-3);
    s.transform = skewed_transform(2);
    check_alike(measure<2>(s, 3), sum_over_grid<2>(s, 3, 1000), 1e-4);
  }
}

TEST_CASE("the moments of a box as a polyhedron are those of the box") {
  ShapeSpec s = solid_shape("box");
  s.transform = skewed_transform(3);
  s.transform.translate += Vec3(100, -50, 20);  // far from the origin
  const auto surface = contact_surface<3>(s, options, Vec3::Constant(-2), Vec3::Constant(2));
  check_alike(mass_of_surface<3>(surface, 5), measure<3>(s, 5), 1e-11);  // a distance of 100 m costs two digits
  s.transform = skewed_transform(2);
  const auto outline = contact_surface<2>(s, options, Vec<2>::Constant(-2), Vec<2>::Constant(2));
  check_alike(mass_of_surface<2>(outline, 5), measure<2>(s, 5), round_off);
}

TEST_CASE("a tetrahedron from a file has its exact moments") {
  const auto file = std::filesystem::temp_directory_path() / "seiche_unit_tetrahedron.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  ShapeSpec s = solid_shape("mesh");
  s.file = file;
  s.transform = {2, {Vec3(0, 0, 1), 90}, Vec3(1, 0, 0)};
  // Unit corner: V = 1/6, int x^2 = 1/60, int x y = 1/120. About the centre V c c' is subtracted; then scaled by two.
  Eigen::Matrix3d second = Eigen::Matrix3d::Constant(1.0 / 120 - 1.0 / 96);
  second.diagonal().setConstant(1.0 / 60 - 1.0 / 96);
  Eigen::Matrix3d r;
  r << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  second = 32 * r * second * r.transpose();
  const Eigen::Matrix3d inertia = 2 * (second.trace() * Eigen::Matrix3d::Identity() - second);
  check_alike(measure<3>(s, 2), {2 * 8.0 / 6, 8.0 / 6, Vec3(0.5, 0.5, 0.5), inertia}, round_off);
  std::filesystem::remove(file);
}

// The smoothed boundary adds (h'/r)^2/4 to the volume of a ball and twice that to its inertia, h' = h/4, r = 5 h: 6e-4.
TEST_CASE("expressions have the moments of their inside") {
  ShapeSpec ball = solid_shape("sphere"), s = solid_shape("expression");
  s.phi = "sqrt((x-0.1)^2+(y+0.2)^2+(z-0.3)^2)-0.25";
  check_alike(measure<3>(s, 3), measure<3>(ball, 3), 0.003);
  s.phi = "sqrt((x-0.1)^2+(y+0.2)^2)-0.25";
  check_alike(measure<2>(s, 3), measure<2>(ball, 3), 0.003);
  ShapeSpec box = solid_shape("box");
  s.phi = "max(max(abs(x+0.125)-0.375,abs(y-0.125)-0.375),abs(z+0.125)-0.625)";
  s.transform = box.transform = {1.3, {Vec3(1, -2, 0.5), 37}, Vec3(0.2, -0.1, 0.3)};
  check_alike(measure<3>(s, 3), measure<3>(box, 3), 0.003);
}

TEST_CASE("what has no end or no inside is no rigid solid") {
  CHECK_THAT(fault<3>(solid_shape("plane")), Contains("scene.toml:14: ") && Contains("plane") && Contains("box"));
  ShapeSpec s = solid_shape("sphere");
  s.invert = true;
  CHECK_THAT(fault<2>(s), Contains("scene.toml:14: ") && Contains("inverted"));
  s = solid_shape("expression");
  s.phi = "y-0.1*x";
  CHECK_THAT(fault<2>(s), Contains("within the domain"));
  CHECK_THAT(fault<3>(s), Contains("within the domain"));
  s.phi = "x*x+y*y+1";
  CHECK_THAT(fault<2>(s), Contains("no volume"));
  CHECK_THAT(fault<3>(s), Contains("no volume"));
  s = solid_shape("box");
  s.upper[0] = s.lower[0];
  CHECK_THAT(fault<3>(s), Contains("the box is empty"));
}

}  // namespace mass_properties_tests
