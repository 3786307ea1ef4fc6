// Joints in scene files.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "base/scene.h"
#include "run/scene.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace joints_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string with_boxes(int dimension, const std::string& joints) {
  const auto box = [&](const char* name, const char* kind, double x) {
    const std::string z = dimension == 3 ? ", 0.4" : "", w = dimension == 3 ? ", 0.6" : "";
    return fmt::format(
        "[[solid]]\nname = \"{}\"\nkind = \"{}\"\nshape = \"box\"\nlower = [{}, 0.4{}]\nupper = [{}, 0.6{}]\n{}", name,
        kind, x, z, x + 0.2, w, std::string(kind) == "rigid" ? "density = 500\n" : "");
  };
  return (dimension == 2 ? flat_scene : small_scene) + box("arm", "rigid", 0.1) + box("hand", "rigid", 0.35) +
         box("post", "static", 0.7) + joints;
}

std::string one(const std::string& keys) {
  return "[[joint]]\nname = \"j\"\n" + keys;
}

// A hinge of arm and hand with these keys.
std::string hinge(const std::string& keys) {
  return one("kind = \"hinge\"\nbetween = [\"hand\", \"arm\"]\nat = [0.3, 0.5]\n" + keys);
}

}  // namespace

TEST_CASE("a joint has a kind, two solids, a place and forces") {
  const JointSpec j = parse(with_boxes(2, hinge("limits = [-45, 60]\nspring = { stiffness = 2, damping = 0.1 }\n"
                                                "motor = { speed = \"3*t\", torque = 5 }\nfriction = 0.2\nradius = "
                                                "0.01\nbreaks_at = { torque = 9 }\ncollide = true\n")))
                          .joints[0];
  CHECK(j.kind == JointKind::hinge);
  CHECK(j.between == std::vector<std::string>{"hand", "arm"});
  CHECK(j.at == Vec3(0.3, 0.5, 0));
  CHECK((*j.limits)[0] == -45);
  CHECK(j.spring->stiffness == 2);
  CHECK_FALSE(j.spring->rest);
  CHECK(j.motor->speed == "3*t");
  CHECK(j.motor->most() == 5);
  CHECK(j.friction == 0.2);
  CHECK(j.breaks_at->torque == 9);
  CHECK(j.radius == 0.01);
  CHECK(j.collide);
  const JointSpec plain =
      parse(with_boxes(2, "[[joint]]\nkind = \"weld\"\nbetween = [\"arm\", \"world\"]\nat = [0, 0]\n")).joints[0];
  CHECK(plain.name == "joint1");
  CHECK_FALSE(plain.motor);
  CHECK_FALSE(plain.collide);
}

TEST_CASE("a joint between solids that are not there, or do not move, is refused") {
  check_refused(with_boxes(2, one("kind = \"weld\"\nbetween = [\"hnad\", \"arm\"]\nat = [0, 0]\n")),
                "no solid is named \"hnad\"; did you mean \"hand\"?");
  check_refused(with_boxes(2, one("kind = \"weld\"\nbetween = [\"hand\", \"hand\"]\nat = [0, 0]\n")), "twice");
  check_refused(with_boxes(2, one("kind = \"weld\"\nbetween = [\"hand\"]\nat = [0, 0]\n")), "array of two names");
  check_refused(with_boxes(2, one("kind = \"weld\"\nbetween = [\"post\", \"world\"]\nat = [0, 0]\n")),
                "do not move by forces");
  check_refused(with_boxes(2, hinge("") + hinge("")), "the name \"j\" of [[joint]] is taken");
}

TEST_CASE("a joint's axis and dimension must fit its kind") {
  const std::string ends = "between = [\"hand\", \"arm\"]\n";
  check_refused(with_boxes(2, hinge("axis = [0, 0, 1]\n")), "remove axis");
  check_refused(with_boxes(2, one("kind = \"ball\"\nat = [0, 0]\n" + ends)), "in 2D a hinge turns about a point");
  check_refused(with_boxes(2, one("kind = \"slider\"\nat = [0, 0]\n" + ends)), "it needs an axis");
  check_refused(with_boxes(2, one("kind = \"slider\"\naxis = [1, 0, 1]\nat = [0, 0]\n" + ends)), "in the plane");
  check_refused(with_boxes(3, one("kind = \"hinge\"\nat = [0, 0, 0]\n" + ends)), "it needs an axis");
  check_refused(with_boxes(3, one("kind = \"hinge\"\naxis = [0, 0, 0]\nat = [0, 0, 0]\n" + ends)), "not zero");
  check_refused(
      with_boxes(3, one("kind = \"universal\"\naxis = [1, 0, 0]\nsecond_axis = [1, 1, 0]\nat = [0, 0, 0]\n" + ends)),
      "perpendicular");
  check_refused(with_boxes(2, one("kind = \"distance\"\nat = [0.5, 0]\nto = [0.5, 0]\n" + ends)), "coincide");
  check_refused(with_boxes(2, one("kind = \"rope\"\nat = [0.5, 0]\nto = [0.5, 1]\nlength = 0.5\n" + ends)),
                "does not reach");
  check_refused(with_boxes(2, one("kind = \"weld\"\naxis = [0, 0, 1]\nat = [0, 0]\n" + ends)), "axis");
}

TEST_CASE("a joint's forces must fit each other and its start") {
  check_refused(with_boxes(2, hinge("limits = [10, -10]\n")), "10 is not below -10");
  check_refused(with_boxes(2, hinge("limits = [10, 20]\n")), "it starts at 0");
  check_refused(with_boxes(2, hinge("drive = { degrees = \"t\" }\nmotor = { speed = 1, torque = 1 }\n")),
                "it has a motor, too");
  check_refused(with_boxes(2, hinge("drive = { degrees = \"5+t\" }\n")), "it must be 0 at t = 0");
  check_refused(with_boxes(2, hinge("drive = { translate = \"t\" }\n")), "driven by degrees");
  check_refused(with_boxes(2, hinge("drive = { degrees = \"0*sqrt(0.3-t)\" }\n")), "not finite at t = 0.3");
  check_refused(with_boxes(2, hinge("motor = { target = \"0*sqrt(0.3-t)\", stiffness = 1 }\n")), "not finite at");
  check_refused(with_boxes(2, hinge("drive = { degrees = \"90*rint(t)\" }\n")), "jumps by 90 degrees at t = 0.5");
  check_refused(with_boxes(2, hinge("motor = { target = 1, stiffness = -1 }\n")), "must be >= 0");
  check_refused(with_boxes(2, hinge("motor = { speed = 1 }\n")), "needs its largest torque");
  check_refused(with_boxes(2, hinge("motor = { speed = 1, torque = 0 }\n")), "must be > 0");
  check_refused(with_boxes(2, hinge("motor = { speed = 1, force = 1 }\n")), "not a force");
  check_refused(with_boxes(2, hinge("motor = { target = 1 }\n")), "needs stiffness or damping");
  check_refused(with_boxes(2, hinge("spring = { stiffness = -1 }\n")), "must be >= 0");
  check_refused(with_boxes(2, hinge("friction = 0.3\n")), "give radius");
  check_refused(with_boxes(2, hinge("breaks_at = { force = 0 }\n")), "must be > 0");
}

TEST_CASE("a joint holds a region of an elastic solid") {
  const std::string soft =
      "[[solid]]\nname = \"tail\"\nkind = \"elastic\"\nshape = \"box\"\nlower = [0.1, 0.7]\nupper = [0.3, 0.9]\n"
      "density = 900\nmaterial = { youngs_modulus = 1e6, poisson_ratio = 0.3 }\nelement_size = 0.05\n";
  const auto joined = [&](const std::string& second, const std::string& keys) {
    return with_boxes(
        2, soft + one(fmt::format("kind = \"weld\"\nbetween = [\"tail\", \"{}\"]\nat = [0.2, 0.7]\n{}", second, keys)));
  };
  const std::string region = "region = { shape = \"box\", lower = [0.1, 0.6], upper = [0.3, 0.8] }\n";
  const Scene scene = parse(joined("arm", region));
  CHECK(scene.joints[0].region->kind == "box");
  CHECK(scene.joints[0].region->upper == Vec3(0.3, 0.8, 0));
  CHECK(parse(write_scene(scene)).joints[0].region->lower == Vec3(0.1, 0.6, 0));
  check_refused(joined("arm", ""), "\"tail\" is elastic; give region");
  check_refused(joined("arm", region + "second_" + region), "\"arm\" is not elastic; remove second_region");
  check_refused(with_boxes(2, hinge(region)), "neither of its solids is elastic");
  check_refused(joined("arm", "region = { shape = \"box\", lower = [0.3, 0.6], upper = [0.1, 0.8] }\n"), "region");
}

TEST_CASE("joints need factors of elastic solids") {
  check_refused(with_boxes(2, hinge("") + "[solver]\nelastic = \"iterate\"\n"), "does not work with [[joint]] yet");
}

TEST_CASE("a gear joins two joints that turn or slide") {
  const std::string gear = "[[joint]]\nkind = \"gear\"\nratio = 2\nbetween = ";
  const std::string weld = "[[joint]]\nname = \"w\"\nkind = \"weld\"\nbetween = [\"arm\", \"world\"]\nat = [0, 0]\n";
  check_refused(with_boxes(2, hinge("") + weld + gear + "[\"j\", \"w\"]\n"), "\"w\" is none; there is \"j\"");
  check_refused(with_boxes(2, hinge("") + gear + "[\"j\", \"hand\"]\n"), "\"hand\" is none");
}

TEST_CASE("joints are written as they were read") {
  for (const int dimension : {2, 3}) {
    const Scene scene = parse(rich_scene(dimension, "sphere", "inflow", "pressure"));
    REQUIRE(scene.joints.size() == 5);
    const std::string text = write_scene(scene);
    CHECK(write_scene(parse(text)) == text);
    const std::string plain = write_scene(parse(with_boxes(dimension, dimension == 2 ? hinge("") : "")));
    CHECK(write_scene(parse(plain)) == plain);
    CHECK_THAT(text, Contains("between = [\"solid3\", \"world\"]") && Contains("limits = [-30.0, 40.0]") &&
                         Contains("ratio = -2.0"));
  }
}

}  // namespace joints_tests
