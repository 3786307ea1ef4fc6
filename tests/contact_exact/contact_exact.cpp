// A tumbling pile never intersects itself, nor the container: triangles against triangles with exact predicates.
#include <random>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include "solid_contact_cases.h"

using namespace seiche;
using namespace seiche::contact_cases;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct Facet {
  int body;
  Kernel::Triangle_3 triangle;
};

std::vector<Facet> facets(const DryWorld<3>& world) {
  std::vector<Facet> list;
  for (size_t b = 0; b < world.bodies.size(); ++b) {
    std::vector<Kernel::Point_3> points;
    for (const Vec3& rest : world.bodies[b].contact.surface.points) {
      const Vec3 x = world.bodies[b].pose.apply(rest);
      points.emplace_back(x[0], x[1], x[2]);
    }
    for (const auto& t : world.bodies[b].contact.surface.triangles)
      list.push_back({static_cast<int>(b), {points[t[0]], points[t[1]], points[t[2]]}});
  }
  return list;
}

// Pairs of triangles of different bodies with a common point.
int intersections(const std::vector<Facet>& list) {
  using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, std::vector<Facet>::const_iterator>;
  std::vector<Box> boxes;
  for (auto f = list.begin(); f != list.end(); ++f) boxes.emplace_back(f->triangle.bbox(), f);
  int found = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    if (a.handle()->body != b.handle()->body && CGAL::do_intersect(a.handle()->triangle, b.handle()->triangle)) ++found;
  });
  return found;
}

// Boxes, plates and balls above a container without a lid.
DryWorld<3> pile(int count) {
  std::mt19937 engine(3);
  const auto random = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(engine); };
  DryWorld<3> world;
  world.gravity = Vec3(0, -9.81, 0);
  auto& container = world.add(inverted(box<3>(Vec3(0.5, 4, 0.5))), Vec3(0, 2, 0), 0, Vec3::Ones());
  container.contact.control = BodyControl::prescribed;
  container.contact.friction = 0.3;
  for (int i = 0; i < count; ++i) {
    const Vec3 center(random(-0.1, 0.1), 0.2 + 0.18 * i, random(-0.1, 0.1));
    DryBody<3>* b;
    if (i % 3 == 0) b = &world.add_box(Vec3(0.1, 0.12, 0.08), center, 1000);
    if (i % 3 == 1) b = &world.add_box(Vec3(0.15, 0.01, 0.12), center, 8000);
    if (i % 3 == 2) b = &world.add(icosphere(0.06, 2), center, 0.9, Vec3::Constant(0.4 * 0.9 * 0.06 * 0.06));
    b->pose.rotation =
        Eigen::Quaterniond(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)).normalized().toRotationMatrix();
    b->velocity << random(-1, 1), -3, random(-1, 1), random(-5, 5), random(-5, 5), random(-5, 5);
    b->contact.friction = 0.4;
  }
  return world;
}

}  // namespace

TEST_CASE("the exact test sees an intersection") {
  DryWorld<3> world;
  world.add_box(Vec3::Ones(), Vec3::Zero(), 1);
  world.add_box(Vec3::Ones(), Vec3(0.999999, 0.1, 0.2), 1);
  CHECK(intersections(facets(world)) > 0);
  world.bodies[1].pose.displacement[0] = 1.000001;
  CHECK(intersections(facets(world)) == 0);
}

TEST_CASE("a tumbling pile never intersects") {
  DryWorld<3> world = pile(21);
  int contacts = 0;
  for (int i = 0; i < 110; ++i) {
    world.step(0.01);
    contacts = std::max(contacts, world.report.active);
    REQUIRE(intersections(facets(world)) == 0);
  }
  CHECK(contacts > 50);
  double highest = 0;
  for (const auto& b : world.bodies)
    if (b.contact.control == BodyControl::free) highest = std::max(highest, b.pose.displacement[1]);
  CAPTURE(world.newton_iterations, world.solves, contacts);
  CHECK(highest < 1);  // it has come down
}
