// Robots of URDF files as solids and joints, and mass properties that a scene gives.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "base/error.h"
#include "base/scene.h"
#include "scene/reader.h"
#include "scene/writer.h"
#include "unit/scene/common.h"

namespace robots_tests {
using namespace seiche;
using namespace seiche::testing;
using Catch::Matchers::Contains;

namespace {

const std::string box = "<collision><geometry><box size=\"0.2 0.1 0.1\"/></geometry></collision>";
const std::string mass =
    "<inertial><origin xyz=\"0.05 0 0\"/><mass value=\"2\"/>"
    "<inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.02\" iyz=\"0\" izz=\"0.025\"/></inertial>";

std::string link(const std::string& name, const std::string& inner) {
  return fmt::format("<link name=\"{}\">{}</link>", name, inner);
}

std::string arm(const std::string& type, const std::string& more) {
  return fmt::format(
      "<joint name=\"elbow\" type=\"{}\"><parent link=\"base\"/><child link=\"arm\"/><origin xyz=\"0.2 0 0\" "
      "rpy=\"0 0 1.5707963267948966\"/><axis xyz=\"0 0 1\"/>{}</joint>",
      type, more);
}

// A scene in a folder of its own, with the robot of these elements.
class RobotScene {
 public:
  explicit RobotScene(const std::string& elements) {
    folder_.write("robot.urdf", "<robot name=\"r\">" + elements + "</robot>");
  }
  Scene read(const std::string& keys = "") const {
    return parse_scene(
        small_scene + "[[robot]]\nname = \"bot\"\nfile = \"robot.urdf\"\ntranslate = [0.5, 0.5, 0.5]\n" + keys,
        "scene.toml", folder_.path(), {});
  }
  void check_refused(const std::string& keys, const std::string& why) const {
    CHECK_THROWS_WITH(read(keys), Contains(why));
  }

 private:
  ScratchFolder folder_;
};

const std::string limits = "<limit lower=\"-0.5\" upper=\"1\" effort=\"3\" velocity=\"2\"/>";

}  // namespace

TEST_CASE("a robot's links become solids with the file's masses, its joints joints") {
  const RobotScene robot(link("base", box + mass) + link("arm", box + mass) + arm("revolute", limits));
  const Scene scene = robot.read();
  REQUIRE(scene.solids.size() == 2);
  REQUIRE(scene.joints.size() == 1);
  CHECK(scene.robots.empty());
  const SolidSpec& arm = scene.solids[1];
  CHECK(arm.name == "bot/arm");
  CHECK(*arm.rigid.mass == 2);
  // Turned by a right angle about z: the centre of mass lies along y, the first two moments are exchanged.
  CHECK((*arm.rigid.center_of_mass - Vec3(0.7, 0.55, 0.5)).norm() <= 1e-12);
  CHECK((*arm.rigid.inertia - Vec3(0.02, 0.01, 0.025)).norm() <= 1e-12);
  const JointSpec& elbow = scene.joints[0];
  CHECK(elbow.name == "bot/elbow");
  CHECK(elbow.kind == JointKind::hinge);
  CHECK(elbow.between == std::vector<std::string>{"bot/arm", "bot/base"});
  CHECK((elbow.at - Vec3(0.7, 0.5, 0.5)).norm() <= 1e-12);
  CHECK((*elbow.limits)[1] == Approx(180 / 3.14159265358979323846));
  const std::string text = write_scene(scene);
  CHECK(write_scene(parse(text)) == text);
}

TEST_CASE("a robot's joints start where the scene says and take its forces") {
  const RobotScene robot(link("base", box + mass) + link("arm", box + mass) + arm("revolute", limits));
  const Scene scene = robot.read(
      "base = \"fixed\"\n[[robot.joint]]\nname = \"elbow\"\nstart = 30\n"
      "motor = { target = \"10*t\", stiffness = 2 }\n");
  REQUIRE(scene.joints.size() == 2);  // the base's weld to the world
  CHECK(scene.joints[0].between == std::vector<std::string>{"bot/base", "world"});
  const JointSpec& elbow = scene.joints[1];
  CHECK((*elbow.limits)[0] == Approx(-0.5 * 180 / 3.14159265358979323846 - 30));
  CHECK(elbow.motor->most() == 3);  // the file's effort
  // The arm's box, 0.2 along x at its link, is turned by 90 and 30 degrees.
  CHECK(scene.solids[1].shape.transform.rotate.degrees == Approx(120));
}

TEST_CASE("links without shapes belong to their neighbours, further shapes are welded") {
  const RobotScene robot(link("frame", "") + link("base", box + box + mass) + link("arm", box + mass) +
                         arm("fixed", "") +
                         "<joint name=\"mount\" type=\"fixed\"><parent link=\"frame\"/><child link=\"base\"/></joint>");
  const Scene scene = robot.read();
  REQUIRE(scene.solids.size() == 3);
  CHECK(scene.solids[1].name == "bot/base.2");
  CHECK(*scene.solids[1].rigid.mass == Approx(2e-6));
  REQUIRE(scene.joints.size() == 2);  // the second shape's, and the arm's
  CHECK(scene.joints[1].kind == JointKind::weld);
}

TEST_CASE("robots that a scene cannot hold are refused") {
  const std::string two = link("base", box + mass) + link("arm", box + mass);
  RobotScene(two + arm("revolute", limits))
      .check_refused("[[robot.joint]]\nname = \"elbwo\"\n", "did you mean \"elbow\"?");
  RobotScene(two + arm("revolute", limits))
      .check_refused("[[robot.joint]]\nname = \"elbow\"\nstart = 90\n", "starts at 90");
  RobotScene(two).check_refused("", "is no robot in URDF");
  RobotScene("<nonsense").check_refused("", "is no robot in URDF");
  RobotScene(link("base", box)).check_refused("", "has no mass in the file; give density");
  RobotScene(link("base", "")).check_refused("", "set base = \"fixed\"");
  RobotScene(link("base", box + mass) + link("arm", mass) + arm("revolute", limits))
      .check_refused("", "moves, but has no collision or visual shape");
  RobotScene(link("base", mass + "<collision><geometry><mesh filename=\"a.dae\"/></geometry></collision>"))
      .check_refused("", "is no .obj, .ply or .stl file");
  RobotScene(link("base", mass + "<collision><geometry><mesh filename=\"../../etc/a.obj\"/></geometry></collision>"))
      .check_refused("", "lies outside the scene's folder");
  CHECK_THROWS_WITH(parse(flat_scene + "[[robot]]\nfile = \"scene.toml\"\n"), Contains("robot"));
}

TEST_CASE("a rigid solid has a density or a mass, and an inertia that a body can have") {
  const auto with = [](const std::string& keys) {
    return small_scene +
           "[[solid]]\nname = \"a\"\nkind = \"rigid\"\nshape = \"box\"\nlower = [0.2, 0.2, 0.2]\nupper = [0.4, 0.4, "
           "0.4]\n" +
           keys;
  };
  const std::string text = with("mass = 3\ncenter_of_mass = [0.3, 0.25, 0.3]\ninertia = [0.1, 0.2, 0.15]\n");
  const Scene scene = parse(text);
  CHECK(*scene.solids[0].rigid.mass == 3);
  CHECK(parse(write_scene(scene)).solids[0].rigid.inertia == Vec3(0.1, 0.2, 0.15));
  CHECK_THROWS_WITH(parse(with("")), Contains("needs 'density' with kind = \"rigid\" (kg/m^3), or 'mass' (kg)"));
  CHECK_THROWS_WITH(parse(with("mass = 1\ndensity = 2\n")), Contains("both density and mass"));
  CHECK_THROWS_WITH(parse(with("mass = 1\ninertia = [0.1, 0.1, 0.3]\n")), Contains("no body has principal moments"));
  CHECK_THROWS_WITH(parse(with("mass = 1\nproducts_of_inertia = [0, 0, 0]\n")), Contains("need inertia beside them"));
}

}  // namespace robots_tests
