// A tumbling pile intersects neither itself nor the container: triangle tests with exact predicates.
#include <random>

#include "exact_intersections.h"
#include "unit/solid/contact_cases.h"

using namespace seiche;
using namespace seiche::contact_cases;

namespace {

int intersections(const DryWorld<3>& world) {
  std::vector<exact::PlacedSurface> surfaces;
  for (const auto& body : world.bodies) {
    surfaces.push_back({body.contact.surface, exact::Mobility::free});
    for (Vec3& x : surfaces.back().mesh.points) x = body.pose.apply(x);
  }
  return exact::intersections(surfaces);
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
  CHECK(intersections(world) > 0);
  world.bodies[1].pose.displacement[0] = 1.000001;
  CHECK(intersections(world) == 0);
}

TEST_CASE("a tumbling pile never intersects", "[long]") {
  DryWorld<3> world = pile(21);
  int contacts = 0;
  for (int i = 0; i < 110; ++i) {
    world.step(0.01);
    contacts = std::max(contacts, world.report.active);
    REQUIRE(intersections(world) == 0);
  }
  CHECK(contacts > 50);
  double highest = 0;
  for (const auto& b : world.bodies)
    if (b.contact.control == BodyControl::free) highest = std::max(highest, b.pose.displacement[1]);
  CAPTURE(world.newton_iterations, world.solves, contacts);
  CHECK(highest < 1);  // the pile has come down
}
