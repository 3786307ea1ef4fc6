// Contact with open surfaces: sheets are touched on both sides and have no inside.
#include <catch2/catch.hpp>

#include "contact_cases.h"
#include "geometry/mesh/surface_tree.h"

namespace contact_sheets_tests {
using namespace seiche;
using namespace seiche::contact_cases;

namespace {

// A square sheet (2D: a line) across y with its middle in the origin, n pieces a side.
template <int Dim>
SurfaceMesh sheet(double side, int n) {
  SurfaceMesh m;
  const int rows = Dim == 2 ? 0 : n;
  for (int k = 0; k <= rows; ++k)
    for (int i = 0; i <= n; ++i)
      m.points.push_back({side * (double(i) / n - 0.5), 0, Dim == 2 ? 0 : side * (double(k) / n - 0.5)});
  const auto at = [&](int i, int k) { return i + (n + 1) * k; };
  for (int i = 0; Dim == 2 && i < n; ++i) m.segments.push_back({i, i + 1});
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      m.triangles.push_back({at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
    }
  return m;
}

template <int Dim>
SurfaceMesh ball(double radius) {
  if constexpr (Dim == 2) return polygon(radius, 24);
  return icosphere(radius, 2);
}

template <int Dim>
DryWorld<Dim> ball_beside_sheet(double height) {
  DryWorld<Dim> world;
  auto& fixed = world.add(sheet<Dim>(1.0, 3), Vec3::Zero(), 0, Vec3::Ones());
  fixed.contact.control = BodyControl::prescribed;
  world.add(ball<Dim>(0.1), {0.07, height, Dim == 2 ? 0 : 0.04}, 1.0, Vec3::Constant(0.004));
  world.gravity = {0, height > 0 ? -9.81 : 9.81, 0};
  return world;
}

// A sheet of point masses that hang together by nothing but their surface: all that contact may move.
template <int Dim>
struct Cloth {
  ContactBody contact;
  Eigen::VectorXd displacement, velocity;
  double mass;  // of a point, kg

  Cloth(double side, int n, double height) {
    SurfaceMesh m = sheet<Dim>(side, n);
    for (Vec3& x : m.points) x[1] += height;
    const int count = int(m.points.size());
    std::vector<int> nodes;
    for (int k = 0; k < count; ++k) nodes.push_back(k);
    mass = 1.0 / count;
    contact = {m, BodyControl::deformable, 1.0, {}, "cloth", nodes, count};
    displacement = velocity = Eigen::VectorXd::Zero(Dim * count);
  }
  Vec<Dim> point(int k) const {
    return truncate<Dim>(contact.surface.points[std::size_t(k)]) + displacement.template segment<Dim>(Dim * k);
  }
};

}  // namespace

TEST_CASE("surfaces are closed, inside out or sheets") {
  const SurfaceTree<3> closed = build_surface_tree<3>(box<3>(Vec3::Ones()), "box");
  CHECK(closed.closed);
  CHECK(closed.volume == Approx(1));
  const SurfaceTree<3> outside = build_surface_tree<3>(inverted(box<3>(Vec3::Ones())), "room");
  CHECK(outside.closed);
  CHECK(outside.volume == Approx(-1));
  SurfaceMesh open = box<3>(Vec3::Ones());
  open.triangles.pop_back();
  CHECK_FALSE(build_surface_tree<3>(open, "open box").closed);
  CHECK(build_surface_tree<3>(open, "open box").volume == 0);
  CHECK_FALSE(build_surface_tree<3>(sheet<3>(1, 2), "sheet").closed);
  CHECK_FALSE(build_surface_tree<2>(sheet<2>(1, 2), "line").closed);
  CHECK(build_surface_tree<2>(polygon(1, 7), "disc").closed);
}

// At rest the barrier carries the ball's weight at a distance within its reach, on the side from which the ball came.
TEMPLATE_TEST_CASE_SIG("a ball comes to rest on either side of a sheet", "", ((int Dim), Dim), 2, 3) {
  for (const double side : {1.0, -1.0}) {
    DryWorld<Dim> world = ball_beside_sheet<Dim>(side * 0.13);
    double lowest = 0;
    for (int n = 0; n < 60; ++n) world.step(0.01);
    for (const Vec3& x : world.bodies[1].contact.surface.points)
      lowest = std::min(lowest, side * world.bodies[1].pose.apply(x)[1] - 1.0);
    CHECK(lowest + 1.0 > 0);
    CHECK(lowest + 1.0 < world.options.reach);
    CHECK(world.bodies[1].velocity.norm() < 0.01);
  }
}

// Seen from within, a bowl fills more than half of all directions: a winding number would call that its inside.
TEMPLATE_TEST_CASE_SIG("a bowl of a sheet contains nothing, but what crosses it overlaps", "", ((int Dim), Dim), 2, 3) {
  SurfaceMesh bowl = box<Dim>(Vec3::Ones());
  if (Dim == 2) bowl.segments = {{2, 0}, {0, 1}, {1, 3}};
  if (Dim == 3) bowl.triangles.erase(bowl.triangles.begin() + 6, bowl.triangles.begin() + 8);  // the top
  for (const double height : {0.0, 0.7, -0.7, -0.45}) {
    DryWorld<Dim> world;
    world.add(bowl, Vec3::Zero(), 0, Vec3::Ones()).contact.control = BodyControl::prescribed;
    world.add(ball<Dim>(0.1), {0, height, 0}, 1, Vec3::Ones());
    std::vector<ContactMotion> motions;
    for (const auto& body : world.bodies) motions.push_back({body.pose, body.pose});
    const std::vector<Overlap> found = find_initial_overlaps<Dim>(world.scene(), motions, 1e-6);
    CHECK(found.size() == (height == -0.45 ? 1 : 0));
  }
}

// The middle of the cloth lies on the ball, its corners fall past.
TEMPLATE_TEST_CASE_SIG("a falling sheet of points drapes over a ball", "", ((int Dim), Dim), 2, 3) {
  Cloth<Dim> cloth(0.6, 8, 0.22);
  ContactBody fixed{ball<Dim>(0.2), BodyControl::prescribed, 0, {}, "ball"};
  const ContactScene<Dim> scene({fixed, cloth.contact}, {});
  const Eigen::Index size = cloth.velocity.size();
  Eigen::SparseMatrix<double> M(size, size);
  M.setIdentity();
  M *= cloth.mass;
  const double dt = 0.01, g = 9.81;
  for (int n = 0; n < 20; ++n) {
    Eigen::VectorXd target = cloth.velocity;
    for (Eigen::Index i = 1; i < size; i += Dim) target[i] -= dt * g;
    DryProblem inertia(M, target);
    const ContactReport report =
        solve_contact<Dim>(scene, {{{}, {}, {}}, {{}, {}, cloth.displacement}}, dt, dt, inertia, {});
    INFO(report.failure);
    REQUIRE(report.failure.empty());
    cloth.velocity = report.velocity;
    cloth.displacement += dt * cloth.velocity;
    REQUIRE(find_initial_overlaps<Dim>(scene, {{{}, {}, {}}, {{}, {}, cloth.displacement}}, 0).empty());
  }
  const int middle = Dim == 2 ? 4 : 4 + 9 * 4;
  CHECK(cloth.point(middle)[1] > 0.19);  // facets of the ball lie up to 2 % within its radius
  CHECK(cloth.point(0)[1] == Approx(0.22 - 0.5 * g * dt * dt * 20 * 21));  // free fall, backward Euler
}

}  // namespace contact_sheets_tests
