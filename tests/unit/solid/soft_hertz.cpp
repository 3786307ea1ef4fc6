// Hertz contact: a rigid cylinder and a rigid sphere pressed into an elastic half-space.
#include "unit/solid/soft_cases.h"

namespace soft_hertz_tests {
using namespace seiche;
using namespace seiche::testing;

namespace {

constexpr double pi = 3.14159265358979323846;

// Maps s in [0, 1] such that steps near 0 are `fine` times the mean step.
double graded(double s, double fine) {
  return fine * s + (1 - fine) * s * s * s;
}

// Convex underside of radius R about (0, R, 0), |x| (and |z|) < half, closed by a lid.
template <int Dim>
SurfaceMesh underside(double R, double half, int count) {
  SurfaceMesh m;
  const auto height = [&](double r2) { return R - std::sqrt(R * R - r2); };
  const auto place = [&](int i) { return half * (2. * i / count - 1); };
  if constexpr (Dim == 2) {
    for (int i = 0; i <= count; ++i) m.points.emplace_back(place(i), height(place(i) * place(i)), 0);
    m.points.emplace_back(0, 4 * half, 0);
    for (int i = 0; i < count + 2; ++i) m.segments.push_back({i, (i + 1) % (count + 2)});
  } else {
    for (int i = 0; i <= count; ++i)
      for (int k = 0; k <= count; ++k)
        m.points.emplace_back(place(i), height(place(i) * place(i) + place(k) * place(k)), place(k));
    const int n = count + 1, top = n * n;
    m.points.emplace_back(0, 4 * half, 0);
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < count; ++k) {
        const int a = i * n + k, b = a + n;
        m.triangles.push_back({a, b, b + 1});
        m.triangles.push_back({a, b + 1, a + 1});
      }
    for (int i = 0; i < count; ++i) {
      m.triangles.push_back({i, i + 1, top});                            // x = -half
      m.triangles.push_back({count * n + i + 1, count * n + i, top});    // x = half
      m.triangles.push_back({(i + 1) * n, i * n, top});                  // z = -half
      m.triangles.push_back({i * n + count, (i + 1) * n + count, top});  // z = half
    }
  }
  return m;
}

struct Pressed {
  double force = 0, width = 0, peak = 0;  // N, m, Pa
};

// Force, contact width a and peak pressure p0 from the contact forces f on the nodes of the soft body. Hertz's p has
// <r^2> = a^2/4 (2D), 2 a^2/5 (3D); with the weight (1 - r^2/a^2)^2 it integrates to 5 pi/16 a p0 (2D), 2 pi/7 a^2 p0
// (3D).
template <int Dim>
Pressed measure(const SoftWorld<Dim>& world, double a) {
  const auto scene = world.scene();
  const auto& s = world.soft[0];
  const auto interval = contact::make_interval<Dim>(scene.data(), world.motions(), 1);
  const auto at = contact::place<Dim>(
      scene.data(), interval,
      contact::all_velocities<Dim>(scene.data(), interval, Eigen::VectorXd::Zero(scene.data().size), 0));
  const auto pairs = contact::find_candidates<Dim>(scene.data(), at.points, at.points, world.options.reach);
  const contact::Weights weights{1, world.options.reach, world.report.stiffness, 1};
  const auto terms =
      contact::contact_terms<Dim>(scene.data(), interval, at, pairs, {}, weights, HessianProjection::exact, {});
  double force = 0, second = 0, weighed = 0;
  for (size_t n = 0; n < s.body.mesh.nodes.size(); ++n) {
    Vec<Dim> x = s.body.mesh.nodes[n] + s.state.u.template segment<Dim>(Dim * Eigen::Index(n));
    x[1] = 0;
    const double f = terms.gradient[Dim * Eigen::Index(n) + 1];
    force += f;
    second += f * x.squaredNorm();
    const double inside = std::max(0., 1 - x.squaredNorm() / (a * a));
    weighed += f * inside * inside;
  }
  Pressed r;
  r.force = force;
  r.width = std::sqrt(second / force * (Dim == 2 ? 4. : 2.5));
  r.peak = weighed / (Dim == 2 ? 5 * pi / 16 * a : 2 * pi / 7 * a * a);
  return r;
}

}  // namespace

TEST_CASE("Hertz: a cylinder pressed into an elastic half-space", "[soft][long]") {
  const double R = 1, E = 1e6, nu = 0.3, aimed = 0.05, size = 1;
  SoftWorld<2> world;
  world.options.reach = 5e-5;
  world.options.acceleration = 0.1;
  world.options.speed_tolerance = 1e-8;
  auto mesh = box_mesh<2>(Vec<2>(-1, -1), Vec<2>(1, 0), IVec<2>(96, 32), 2);
  for (auto& X : mesh.nodes) X = size * Vec<2>(std::copysign(graded(std::abs(X[0]), 0.1), X[0]), -graded(-X[1], 0.1));
  auto& s = world.add(std::move(mesh), 1000, E, nu);
  for (size_t n = 0; n < s.body.mesh.nodes.size(); ++n) {
    const Vec<2> X = s.body.mesh.nodes[n];
    if (X[1] < -size + 1e-9 || std::abs(X[0]) > size - 1e-9) s.held[2 * int(n)] = s.held[2 * int(n) + 1] = 0;
  }
  auto& punch = world.add_rigid(underside<2>(R, 4 * aimed, 400), Vec3(0, 1e-4, 0), 0, Vec3::Ones());
  punch.contact.control = BodyControl::prescribed;
  const double Es = E / (1 - nu * nu);
  // The indentation of a line contact depends on the size of the body. This one gives about the intended width here.
  const double depth = aimed * aimed / R * (std::log(2 * size / aimed) - 0.5) * 0.75;
  for (int n = 1; n <= 4; ++n) {
    Pose end = world.rigid[0].pose;
    end.displacement[1] = 1e-4 - depth * n / 4;
    world.step(10, {{0, end}});
  }
  double a = aimed;
  Pressed found = measure(world, a);
  a = std::sqrt(4 * found.force * R / (pi * Es));
  found = measure(world, a);
  const double p0 = 2 * found.force / (pi * a);
  WARN("cylinder: F' " << found.force << " N/m, a " << found.width << " (Hertz " << a << ", " << found.width / a - 1
                       << "), p0 " << found.peak << " (Hertz " << p0 << ", " << found.peak / p0 - 1 << "), "
                       << world.newton_iterations << " iterations, gap " << world.report.smallest_gap << " active "
                       << world.report.active);
  CHECK(found.width == Approx(a).epsilon(0.05));
  CHECK(found.peak == Approx(p0).epsilon(0.05));
}

// A quarter of the half-space between its planes of symmetry.
TEST_CASE("Hertz: a sphere pressed into an elastic half-space", "[soft][long]") {
  const double R = 1, E = 1e6, nu = 0.3, aimed = 0.1, size = 1;
  SoftWorld<3> world;
  world.options.reach = 2e-4;
  world.options.acceleration = 1;
  world.options.speed_tolerance = 1e-8;
  auto mesh = box_mesh<3>(Vec<3>(0, -1, 0), Vec<3>(1, 0, 1), IVec<3>(6, 6, 6), 2);
  for (auto& X : mesh.nodes) X = size * Vec<3>(graded(X[0], 0.15), -graded(-X[1], 0.15), graded(X[2], 0.15));
  auto& s = world.add(std::move(mesh), 1000, E, nu);
  for (size_t n = 0; n < s.body.mesh.nodes.size(); ++n) {
    const Vec<3> X = s.body.mesh.nodes[n];
    for (int axis = 0; axis < 3; ++axis) {
      const bool far = X[1] < -size + 1e-9 || X[0] > size - 1e-9 || X[2] > size - 1e-9;
      if (far || (axis != 1 && X[axis] < 1e-9)) s.held[3 * int(n) + axis] = 0;
    }
  }
  auto& punch = world.add_rigid(underside<3>(R, 2 * aimed, 80), Vec3(0, 3e-4, 0), 0, Vec3::Ones());
  punch.contact.control = BodyControl::prescribed;
  for (int n = 1; n <= 1; ++n) {
    Pose end = world.rigid[0].pose;
    end.displacement[1] = 3e-4 - aimed * aimed / R * n;
    world.step(10, {{0, end}});
  }
  Pressed found = measure(world, aimed);
  const double Es = E / (1 - nu * nu), a = std::cbrt(0.75 * 4 * found.force * R / Es);
  found = measure(world, a);
  const double p0 = 1.5 * 4 * found.force / (pi * a * a);
  WARN("sphere: F " << 4 * found.force << " N, a " << found.width << " (Hertz " << a << ", " << found.width / a - 1
                    << "), p0 " << 4 * found.peak << " (Hertz " << p0 << ", " << 4 * found.peak / p0 - 1 << "), "
                    << world.newton_iterations << " iterations, gap " << world.report.smallest_gap << " active "
                    << world.report.active);
  CHECK(found.width == Approx(a).epsilon(0.05));
  CHECK(4 * found.peak == Approx(p0).epsilon(0.05));
}

}  // namespace soft_hertz_tests
