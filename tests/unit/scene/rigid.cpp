// Rigid solids, friction and separating liquid in scene files.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "run/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace rigid_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string scene_of(int dimension) {
  return dimension == 2 ? flat_scene : small_scene;
}

std::string ball(int dimension, const std::string& keys) {
  const std::string center = dimension == 2 ? "[0.5, 0.5]" : "[0.5, 0.5, 0.5]";
  return scene_of(dimension) + "[[solid]]\nkind = \"rigid\"\nshape = \"sphere\"\nradius = 0.1\ncenter = " + center +
         "\n" + keys;
}

// A ball of density 400 with additional keys.
std::string heavy(int dimension, const std::string& keys) {
  return ball(dimension, "density = 400\n" + keys + "\n");
}

RigidSpec rigid_of(const std::string& text) {
  return parse(text).solids[0].rigid;
}

void check_refused(const std::string& text, const std::string& expected) {
  INFO(text);
  const std::string message = fault(text);
  CHECK_THAT(message, StartsWith("scene.toml:"));
  CHECK_THAT(message, Contains(expected));
}

using Axes = std::array<bool, 3>;

}  // namespace

TEST_CASE("a rigid solid has density, velocities, friction and what is fixed") {
  const Scene scene = parse(
      heavy(3, "velocity = [1, 2, 3]\nangular_velocity = [4, 0, -0.0]\nfriction = 0.3\nfixed = [\"rotation_y\"]"));
  const SolidSpec& solid = scene.solids[0];
  CHECK(solid.kind == SolidKind::rigid);
  CHECK(solid.rigid.density == 400);
  CHECK(solid.rigid.velocity == Vec3(1, 2, 3));
  CHECK(solid.rigid.angular_velocity == Vec3(4, 0, 0));
  CHECK(solid.friction == 0.3);
  CHECK(solid.rigid.fixed_position == Axes{false, false, false});
  CHECK(solid.rigid.fixed_rotation == Axes{false, true, false});
  const SolidSpec plain = parse(ball(3, "density = 1\n")).solids[0];
  CHECK(!plain.friction);
  CHECK(plain.rigid.velocity.isZero(0));
  CHECK(plain.rigid.fixed_rotation == Axes{false, false, false});
}

TEST_CASE("any solid may have friction") {
  const std::string shape = "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n";
  CHECK(parse(small_scene + "[[solid]]\n" + shape + "friction = 1e6\n").solids[0].friction == 1e6);
  CHECK(parse(small_scene + "[[solid]]\nkind = \"kinematic\"\nmotion = {}\n" + shape + "friction = 0\n")
            .solids[0]
            .friction == 0.0);
}

TEST_CASE("in 2D the angular velocity is one number") {
  for (const char* text : {"2.5", "[2.5]", "[0, 0, 2.5]"}) {
    CHECK(rigid_of(heavy(2, fmt::format("angular_velocity = {}", text))).angular_velocity == Vec3(0, 0, 2.5));
  }
  for (const char* text : {"[]", "[1, 2]", "[0, 1, 2]", "[1, 0, 0]", "[1, 2, 3, 4]"}) {
    check_refused(heavy(2, fmt::format("angular_velocity = {}", text)), "must be one number (rad/s) in 2D");
  }
  check_refused(heavy(2, "angular_velocity = nan"), "angular_velocity must be a finite number");
  check_refused(heavy(2, "angular_velocity = [\"a\"]"), "angular_velocity.0 must be a number");
  check_refused(heavy(2, "angular_velocity = true"),
                "angular_velocity must be an array of three numbers (2D: a number)");
  check_refused(heavy(3, "angular_velocity = 2"), "angular_velocity must be an array of three numbers");
  check_refused(heavy(3, "angular_velocity = [1, 2]"), "must have 3 components");
}

TEST_CASE("fixed lists axes and rotations") {
  CHECK(rigid_of(heavy(3, "fixed = [\"rotation\"]")).fixed_rotation == Axes{true, true, true});
  CHECK(rigid_of(heavy(2, "fixed = [\"rotation\", \"x\"]")).fixed_rotation == Axes{true, true, true});
  CHECK(rigid_of(heavy(2, "fixed = [\"rotation\", \"x\"]")).fixed_position == Axes{true, false, false});
  const RigidSpec held = rigid_of(heavy(3, "fixed = [\"x\", \"y\", \"z\", \"rotation\"]"));
  CHECK(held.fixed_position == Axes{true, true, true});
  const RigidSpec hinge =
      rigid_of(heavy(3, "fixed = [\"z\", \"rotation_x\", \"y\", \"x\", \"rotation_y\"]\nangular_velocity = [0, 0, 1]"));
  CHECK(hinge.fixed_position == Axes{true, true, true});
  CHECK(hinge.fixed_rotation == Axes{true, true, false});
}

TEST_CASE("what is fixed must exist, be said once and not move") {
  check_refused(heavy(3, "fixed = [\"rotatoin\"]"), "did you mean \"rotation\"?");
  check_refused(heavy(3, "fixed = [\"rotation-z\"]"), "did you mean \"rotation_z\"?");
  check_refused(heavy(3, "fixed = [\"w\"]"), "solid.0.fixed.0 must be \"x\", \"y\"");
  check_refused(heavy(3, "fixed = [\"x\", \"x\"]"), "lists \"x\" twice");
  check_refused(heavy(3, "fixed = [\"rotation\", \"rotation_x\"]"), "lists \"rotation_x\" twice");
  check_refused(heavy(3, "fixed = \"x\""), "must be an array of names in quotes");
  check_refused(heavy(3, "fixed = [1]"), "solid.0.fixed.0 must be a name in quotes");
  check_refused(heavy(2, "fixed = [\"z\"]"),
                "solid.0.fixed.0 must be \"x\", \"y\" or \"rotation\", not the text \"z\"");
  check_refused(heavy(2, "fixed = [\"rotation_z\"]"), "did you mean \"rotation\"?");
  check_refused(heavy(3, "fixed = [\"y\"]\nvelocity = [1, 2, 3]"), "solid.0.velocity is 2 for y, but fixed includes y");
  check_refused(heavy(2, "fixed = [\"rotation\"]\nangular_velocity = 1"), "solid.0.angular_velocity is 1 for z");
}

TEST_CASE("inertia and friction lie in their ranges") {
  check_refused(ball(3, ""), "[[solid]] needs 'density' with kind = \"rigid\"");
  for (const char* value : {"0", "-1", "nan", "inf", "1e16"}) {
    check_refused(ball(3, fmt::format("density = {}\n", value)), "solid.0.density must be > 0 kg/m^3");
  }
  for (const char* value : {"-0.1", "nan", "inf"}) {
    check_refused(heavy(3, fmt::format("friction = {}", value)), "solid.0.friction must be >= 0");
  }
  check_refused(heavy(3, "velocity = [nan, 0, 0]"), "solid.0.velocity.0 must be a finite number");
  check_refused(heavy(3, "velocity = [\"t\", 0, 0]"), "solid.0.velocity.0 must be a number");
  check_refused(heavy(3, "motion = {}"), "'motion' in [[solid]] is only for kind = \"kinematic\"");
  check_refused(heavy(3, "frction = 1"), "did you mean 'friction'?");
}

TEST_CASE("a rigid solid is bounded") {
  check_refused(small_scene +
                    "[[solid]]\nkind = \"rigid\"\ndensity = 1\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = "
                    "[0, 1, 0]\n",
                "a rigid solid must be bounded: a plane is not; write it as a box");
  check_refused(heavy(3, "invert = true"), "a rigid solid must be bounded: an inverted shape is not");
}

TEST_CASE("liquid separates only where the scene says so") {
  CHECK(!parse(small_scene).liquid.separates);
  CHECK(parse(small_scene + "[liquid]\nseparates = true\n").liquid.separates);
  check_refused(small_scene + "[liquid]\nseparates = 1\n", "liquid.separates must be true or false");
}

// Independent of the writer: compares the data.
TEST_CASE("rigid solids survive being written") {
  for (const int dimension : {2, 3}) {
    const std::string last = dimension == 2 ? "angular_velocity = 0.1\nfixed = [\"y\"]\nvelocity = [0.3, 0]"
                                            : "angular_velocity = [0.1, 0, 0.3]\nfixed = [\"y\", \"rotation_y\"]\n"
                                              "velocity = [0.3, 0, 1e-17]";
    for (const std::string& keys : {last, std::string("fixed = [\"rotation\"]"), std::string()}) {
      const Scene scene = parse(heavy(dimension, keys + "\nfriction = 0.7"));
      const std::string written = write_scene(scene);
      INFO(written);
      const Scene again = parse(written);
      const RigidSpec &a = scene.solids[0].rigid, &b = again.solids[0].rigid;
      CHECK(again.solids[0].kind == SolidKind::rigid);
      CHECK(a.density == b.density);
      CHECK(a.velocity == b.velocity);
      CHECK(a.angular_velocity == b.angular_velocity);
      CHECK(a.fixed_position == b.fixed_position);
      CHECK(a.fixed_rotation == b.fixed_rotation);
      CHECK(again.solids[0].friction == 0.7);
      CHECK(scene_hash(scene) == scene_hash(again));
    }
  }
}

TEST_CASE("a run does not go on with another rigid solid than it began with") {
  const std::string text = heavy(3, "");
  const Scene before = parse(text);
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"solid.0.density", "401"},
                                                        {"solid.0.velocity", "[1, 0, 0]"},
                                                        {"solid.0.angular_velocity", "[1, 0, 0]"},
                                                        {"solid.0.fixed", "[\"x\"]"},
                                                        {"solid.0.friction", "0.5"},
                                                        {"liquid.separates", "true"}}) {
    const Scene after = parse(text, {{key, value}});
    const std::vector<std::string> changed = changed_keys(before, after);
    CHECK(changed == std::vector<std::string>{key});
    CHECK(forbidden_changes(changed, EditPolicy::force) == changed);
    CHECK(scene_hash(before) != scene_hash(after));
  }
}

}  // namespace rigid_tests
