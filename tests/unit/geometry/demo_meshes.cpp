// Meshes of the demo scenes: their construction, and checks. Each is the zero of a formula, contoured and then
// projected onto the zero (the wheel is extruded). If a test finds another mesh than the committed one, it writes its
// own to the temporary folder.
#include <catch2/catch.hpp>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>

#include "geometry/mesh/mesh.h"
#include "geometry/vdb/openvdb_adapter.h"

namespace demo_meshes_tests {
using namespace seiche;

namespace {

constexpr double pi = 3.14159265358979323846;

struct DemoMesh {
  std::string name;
  std::function<double(const Vec3&)> phi;  // a distance to first order near its zero, m
  Vec3 lower, upper;
  double spacing;
};

// A river pebble 0.16 m long: an ellipsoid with soft dents.
double pebble(const Vec3& x) {
  const Vec3 axes(0.08, 0.045, 0.06);
  const double dents = 0.05 * std::sin(38 * x[0] + 1) * std::cos(31 * x[2]) + 0.04 * std::sin(45 * x[1] + 20 * x[0]);
  return (x.cwiseQuotient(axes).norm() - 1 + dents) * axes.minCoeff();
}

// min(a, b), rounded over the width k.
double smooth_min(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

// One leg of the gyre: a tube that tapers while it winds upwards and inwards.
double leg(const Vec3& x, double angle) {
  constexpr int steps = 160;
  double least = INFINITY;
  for (int i = 0; i <= steps; ++i) {
    const double s = double(i) / steps, turn = angle + 1.25 * pi * s;
    const double r = 0.15 * std::cos(pi / 2 * s) + 0.012;
    const Vec3 p(r * std::cos(turn), 0.37 * std::sin(pi / 2 * s) - 0.01, r * std::sin(turn));
    least = std::min(least, (x - p).norm() - (0.036 - 0.008 * s));
  }
  return least;
}

// Three intertwined legs, 0.4 m tall, cut flat at y = 0 so that it stands.
double gyre(const Vec3& x) {
  const double pair = smooth_min(leg(x, 0), leg(x, 2 * pi / 3), 0.03);
  return std::max(smooth_min(pair, leg(x, 4 * pi / 3), 0.03), -x[1]);
}

// Distance, to first order, from an ellipsoid with these half axes.
double ellipsoid(const Vec3& x, const Vec3& center, const Vec3& axes) {
  const Vec3 r = (x - center).cwiseQuotient(axes);
  return r.norm() * (r.norm() - 1) / std::max(r.cwiseQuotient(axes).norm(), 1e-9);
}

// A bath duck 0.22 m long facing along x: body with wings, a raised tail, head and bill, joined smoothly. Its middle is
// broad, so that it floats upright up to half submerged.
double duck(const Vec3& point) {
  const Vec3 x(point[0], point[1], std::abs(point[2]));
  double d = ellipsoid(x, {0, 0.05, 0}, {0.082, 0.046, 0.066});
  const Vec3 tail(-0.05, 0.055, 0), upwards(-0.05, 0.04, 0);
  const double along = std::clamp((x - tail).dot(upwards) / upwards.squaredNorm(), 0.0, 1.0);
  d = smooth_min(d, (x - tail - along * upwards).norm() - (0.036 - 0.026 * along), 0.03);
  d = smooth_min(d, ellipsoid(x, {-0.02, 0.068, 0.054}, {0.05, 0.026, 0.018}), 0.012);
  d = smooth_min(d, ellipsoid(x, {0.05, 0.125, 0}, {0.04, 0.037, 0.036}), 0.03);
  return smooth_min(d, ellipsoid(x, {0.09, 0.119, 0}, {0.03, 0.011, 0.022}), 0.012);
}

std::vector<DemoMesh> demo_meshes() {
  return {{"pebble", pebble, Vec3(-0.1, -0.07, -0.08), Vec3(0.1, 0.07, 0.08), 0.005},
          {"gyre", gyre, Vec3(-0.22, -0.0155, -0.22), Vec3(0.22, 0.42, 0.22), 0.009},
          {"duck", duck, Vec3(-0.125, -0.01, -0.085), Vec3(0.135, 0.175, 0.085), 0.0095}};
}

Vec3 gradient(const DemoMesh& demo, const Vec3& x) {
  const double e = 1e-5;
  Vec3 g;
  for (int a = 0; a < 3; ++a) g[a] = (demo.phi(x + e * Vec3::Unit(a)) - demo.phi(x - e * Vec3::Unit(a))) / (2 * e);
  return g;
}

// Newton steps along the gradient, each at most a quarter of the spacing.
Vec3 onto_zero(const DemoMesh& demo, Vec3 x) {
  for (int i = 0; i < 4; ++i) {
    const Vec3 g = gradient(demo, x);
    const Vec3 step = demo.phi(x) * g / std::max(g.squaredNorm(), 1e-6);
    x -= step * std::min(1.0, 0.25 * demo.spacing / std::max(step.norm(), 1e-300));
  }
  return x;
}

SurfaceMesh build(const DemoMesh& demo) {
  std::array<int, 3> nodes;
  for (int a = 0; a < 3; ++a) nodes[a] = int((demo.upper[a] - demo.lower[a]) / demo.spacing) + 2;
  std::vector<float> values;
  for (int k = 0; k < nodes[2]; ++k) {
    for (int j = 0; j < nodes[1]; ++j) {
      for (int i = 0; i < nodes[0]; ++i) values.push_back(float(demo.phi(demo.lower + demo.spacing * Vec3(i, j, k))));
    }
  }
  SurfaceMesh mesh = vdb::contour(values, nodes, demo.lower, demo.spacing);
  for (Vec3& p : mesh.points) p = onto_zero(demo, p);
  return mesh;
}

// A water wheel about the z axis: a hub with eight flat blades, 0.6 m across and 0.3 m wide. Its outline goes around
// once; the cap is a fan over the hub and two triangles per blade.
SurfaceMesh wheel() {
  constexpr int blades = 8;
  constexpr double hub = 0.1, radius = 0.3, half_width = 0.02, depth = 0.15;
  SurfaceMesh mesh;
  for (const double z : {-depth, depth})
    for (int blade = 0; blade < blades; ++blade) {
      const Vec3 along(std::cos(2 * pi * blade / blades), std::sin(2 * pi * blade / blades), 0);
      const Vec3 across(-half_width * along[1], half_width * along[0], 0);
      const double foot = std::sqrt(hub * hub - half_width * half_width);
      for (const auto& [r, side] : {std::pair(foot, -1), {radius, -1}, {radius, 1}, {foot, 1}})
        mesh.points.push_back(r * along + side * across + Vec3(0, 0, z));
    }
  const int n = 4 * blades, low = 2 * n, high = low + 1;
  mesh.points.insert(mesh.points.end(), {Vec3(0, 0, -depth), Vec3(0, 0, depth)});
  const auto cap = [&](int a, int b, int c) {
    mesh.triangles.push_back({a == low ? low : a % n, c % n, b % n});
    mesh.triangles.push_back({a == low ? high : n + a % n, n + b % n, n + c % n});
  };
  for (int k = 0; k < n; k += 4) {
    cap(low, k, k + 3);
    cap(low, k + 3, k + 4);
    cap(k, k + 1, k + 2);
    cap(k, k + 2, k + 3);
  }
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    mesh.triangles.push_back({k, next, n + next});
    mesh.triangles.push_back({k, n + next, n + k});
  }
  return mesh;
}

template <class Number>
void put(std::string& bytes, Number value) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &value, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

std::string ply(const SurfaceMesh& mesh, const std::string& name) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}, made for Seiche; lengths in m\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      name, mesh.points.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.points) {
    for (int a = 0; a < 3; ++a) put(bytes, float(p[a]));
  }
  for (const auto& t : mesh.triangles) {
    put(bytes, char(3));
    for (const int corner : t) put(bytes, corner);
  }
  return bytes;
}

std::filesystem::path committed(const std::string& name) {
  const auto root = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path().parent_path();
  return root / "scenes" / "meshes" / (name + ".ply");
}

// Compares with the committed file (coordinates as floats). A different mesh is written to the temporary folder, for
// inspection and copying.
void check_committed(const std::string& name, const SurfaceMesh& made) {
  CAPTURE(name);
  std::ifstream file(committed(name), std::ios::binary);
  const std::string held{std::istreambuf_iterator<char>(file), {}}, fresh = ply(made, name);
  const auto differs = std::filesystem::temp_directory_path() / (name + ".ply");
  if (held != fresh) std::ofstream(differs, std::ios::binary) << fresh;
  INFO("the mesh as its formula gives it: " << differs.string());
  CHECK(held.size() == fresh.size());
  CHECK((held == fresh));
}

}  // namespace

TEST_CASE("the demo meshes are those that their formulas give", "[long]") {
  for (const DemoMesh& demo : demo_meshes()) check_committed(demo.name, build(demo));
  check_committed("wheel", wheel());
}

TEST_CASE("the demo meshes are small, closed in one piece and lie on the zeros of their formulas") {
  for (const DemoMesh& demo : demo_meshes()) {
    CAPTURE(demo.name);
    CHECK(std::filesystem::file_size(committed(demo.name)) < 300000);
    std::vector<std::string> notes;
    const SurfaceMesh mesh = read_closed_mesh(committed(demo.name), notes);
    CHECK(notes.empty());
    const auto far = [&](const Vec3& p) { return std::abs(demo.phi(p)) > 0.02 * demo.spacing; };
    // At the sharp rim of a foot a point cannot lie on both faces.
    CHECK(std::count_if(mesh.points.begin(), mesh.points.end(), far) <= long(mesh.points.size() / 50));
  }
}

TEST_CASE("the gyre stands on y = 0 and is 0.4 m tall") {
  std::vector<std::string> notes;
  const SurfaceMesh mesh = read_closed_mesh(committed("gyre"), notes);
  double low = INFINITY, high = -INFINITY;
  for (const Vec3& p : mesh.points) {
    low = std::min(low, p[1]);
    high = std::max(high, p[1]);
  }
  CHECK(low == Approx(0).margin(1e-6));     // float coordinates
  CHECK(high == Approx(0.4).margin(0.02));  // about
}

TEST_CASE("the wheel is closed and has the volume of its hub and blades") {
  std::vector<std::string> notes;
  const SurfaceMesh mesh = read_closed_mesh(committed("wheel"), notes);
  CHECK(notes.empty());
  double volume = 0;
  for (const auto& t : mesh.triangles) volume += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6;
  // The hub is a polygon of eight chords over the blades' feet and eight between them; eight blades begin at the feet.
  const double foot_angle = std::asin(0.2), foot = 0.1 * std::cos(foot_angle);
  const double hub = 8 * (0.02 * foot + 0.005 * std::sin(2 * pi / 8 - 2 * foot_angle));
  CHECK(volume == Approx(0.3 * (hub + 8 * 0.04 * (0.3 - foot))).epsilon(1e-5));  // float coordinates
}

}  // namespace demo_meshes_tests
