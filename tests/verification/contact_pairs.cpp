// Friction of pairs, and pairs that pass through each other.
#include <catch2/catch.hpp>

#include "base/scene.h"
#include "rigid_scenes.h"

namespace contact_pairs_tests {
using namespace seiche;

namespace {

constexpr double g = 9.81;

ContactSpec friction_between(const std::vector<std::string>& names, double friction) {
  ContactSpec contact;
  contact.between = names;
  contact.friction = friction;
  return contact;
}

ContactSpec passing(const std::string& a, const std::string& b) {
  ContactSpec contact;
  contact.between = {a, b};
  contact.collide = false;
  return contact;
}

// A flat block on a static slab, both turned: gravity leans by 30 degrees instead.
Scene incline(const std::vector<ContactSpec>& contacts) {
  Scene s = test::box_scene(2, 16, 4);
  s.gravity = g * Vec3(0.5, -std::sqrt(0.75), 0);
  s.time.max_step = 0.005;
  s.solids = {test::rigid_box("block", {1, 0.2, 0}, {0.8, 0.6077, 0}, 500),
              test::rigid_box("slab", {3.9, 0.4, 0}, {2, 0.3, 0}, 500)};
  s.solids[1].kind = SolidKind::fixed;
  s.contacts = contacts;
  return s;
}

double acceleration(const Scene& scene) {
  const auto sim = make_simulation(scene, Communicator());
  double first = 0;
  for (const double t : {0.2, 0.5}) {
    while (sim->time() < t) (void)sim->step(t);
    if (t < 0.3) first = sim->solids()[0].velocity[0];
  }
  return (sim->solids()[0].velocity[0] - first) / 0.3;
}

}  // namespace

TEST_CASE("a pair has the friction of the last entry that names it") {
  const double exact = g * (0.5 - 0.3 * std::sqrt(0.75));
  CHECK(acceleration(incline({friction_between({"bl*", "slab"}, 0.3)})) == Approx(exact).epsilon(0.01));
  CHECK(acceleration(incline({friction_between({"*"}, 0.9), friction_between({"slab", "block"}, 0.3)})) ==
        Approx(exact).epsilon(0.01));
  CHECK(acceleration(incline({friction_between({"block", "domain"}, 0.9)})) ==
        Approx(0.5 * g).epsilon(0.01));                                               // it touches no side
  CHECK(std::abs(acceleration(incline({friction_between({"*"}, 0.9)}))) < 0.01 * g);  // 0.9 > tan 30
}

// Two boxes that fly at each other swap places, with the momentum that they had.
TEST_CASE("solids that do not collide pass through each other") {
  for (const int dim : {2, 3}) {
    Scene s = test::box_scene(dim, 16);
    const double z = dim == 2 ? 0 : 0.5;
    s.solids = {test::rigid_box("a", {0.2, 0.2, 0.2}, {0.25, 0.5, z}, 500),
                test::rigid_box("b", {0.2, 0.2, 0.2}, {0.75, 0.52, z}, 800)};
    s.solids[0].rigid.velocity = {1, 0, 0};
    s.solids[1].rigid.velocity = {-1, 0, 0};
    s.contacts = {passing("a", "b")};
    const auto sim = make_simulation(s, Communicator());
    while (sim->time() < 0.5) sim->step(0.5);
    CHECK(sim->solids()[0].position[0] == Approx(0.75).epsilon(1e-9));
    CHECK(sim->solids()[1].position[0] == Approx(0.25).epsilon(1e-9));
  }
}

// A body that is led through another one in water: they overlap on the way, and the run goes on.
TEST_CASE("solids pass through each other in water") {
  Scene s = test::box_scene(2, 24);
  s.gravity = {0, -g, 0};
  test::add_pool(s, 0.7);
  s.solids = {test::rigid_box("sinks", {0.15, 0.15, 0}, {0.5, 0.55, 0}, 2000),
              test::rigid_box("post", {0.3, 0.2, 0}, {0.5, 0.3, 0}, 500)};
  s.solids[1].kind = SolidKind::fixed;
  s.contacts = {passing("sinks", "post")};
  const auto sim = make_simulation(s, Communicator());
  double fastest = 0;
  while (sim->time() < 0.45) fastest = std::max(fastest, sim->step(0.45).max_speed);
  CHECK(sim->solids()[0].position[1] < 0.45);  // within the post
  CHECK(fastest < 4);                          // of the order of a free fall through its way
}

}  // namespace contact_pairs_tests
