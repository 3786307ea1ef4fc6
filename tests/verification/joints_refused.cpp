// Joints that contradict each other in motion, formulas that end and bodies that leave stop the run with the joint's
// name. Joints far from their bodies are told.
#include <catch2/catch.hpp>

#include "base/error.h"
#include "joint_scenes.h"

namespace joints_refused_tests {
using namespace seiche;
using Catch::Matchers::Contains;
using test::hinge, test::joint;

namespace {

Scene one_box(const std::string& degrees) {
  Scene s = test::swing_scene(2, 0.5, 0.05);
  s.solids = {test::rigid_box("box", {0.3, 0.2, 0}, Vec3::Zero(), 500)};
  s.joints = {hinge("turn", "box", "world", Vec3::Zero())};
  s.joints[0].drive.emplace().degrees = degrees;
  return s;
}

void check_stopped(const Scene& s, const std::string& message) {
  const auto sim = make_simulation(s, Communicator());
  try {
    while (sim->time() < 1) (void)sim->step(1);
    FAIL("the run went on");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::cannot_continue);
    CHECK_THAT(error.what(), Contains("'turn'") && Contains(message));
  }
}

}  // namespace

TEST_CASE("joints: those that contradict each other in motion are named", "[joints]") {
  Scene s = one_box("-90*t");
  s.joints.insert(s.joints.begin(), joint("lock", JointKind::weld, "box", "world", Vec3::Zero()));
  check_stopped(s, "contradicts them");
}

// A box that a weld and a drive hold through another one.
TEST_CASE("joints: all joints of a loop that cannot close are named", "[joints]") {
  Scene s = one_box("-90*t");
  s.solids.push_back(test::rigid_box("next", {0.1, 0.1, 0}, {0.3, 0, 0}, 500));
  s.solids.push_back(test::rigid_box("aside", {0.1, 0.1, 0}, {0, 0.3, 0}, 500));
  s.joints.push_back(joint("bolt", JointKind::weld, "next", "box", {0.2, 0, 0}));
  s.joints.push_back(joint("lock", JointKind::weld, "next", "world", {0.3, 0, 0}));
  s.joints.push_back(hinge("free", "aside", "box", {0, 0.2, 0}));
  check_stopped(s, "joints 'turn', 'bolt', 'lock' cannot close");
}

TEST_CASE("joints: a body that leaves the domain on a joint is named with it", "[joints]") {
  Scene s = test::swing_scene(2, 0.5, 0.05, 0);
  s.domain.sides[0][1].type = SideType::outflow;
  s.solids = {test::rigid_box("box", {0.1, 0.1, 0}, {0.3, 0, 0}, 500)};
  s.solids[0].rigid.velocity = Vec3(2, 0, 0);
  s.joints = {joint("turn", JointKind::slider, "box", "world", {0.3, 0, 0})};
  s.joints[0].axis = Vec3(1, 0, 0);
  check_stopped(s, "solid 'box' has left the domain");
  s.joints[0].breaks_at.emplace().force = 1;
  s.joints[0].limits = std::array<double, 2>{-0.1, 0.1};  // breaks there
  const auto sim = make_simulation(s, Communicator());
  while (sim->time() < 1) (void)sim->step(1);
  CHECK(sim->solids()[0].position[0] > 0.6);
}

TEST_CASE("joints: a body that is outside at the start is refused with the joint's line", "[joints]") {
  for (const int dim : {2, 3}) {
    Scene s = test::swing_scene(dim, 0.5, 0.05, 0);
    s.domain.sides[0][1].type = SideType::outflow;
    s.solids = {test::rigid_box("box", {0.1, 0.1, dim == 3 ? 0.1 : 0}, {0.8, 0, 0}, 500)};
    s.joints = {joint("turn", JointKind::slider, "box", "world", {0.8, 0, 0})};
    s.joints[0].axis = Vec3(1, 0, 0);
    s.joints[0].where = "scene.toml:31";
    try {
      (void)make_simulation(s, Communicator());
      FAIL("the scene was taken");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::bad_input);
      CHECK_THAT(error.what(),
                 Contains("scene.toml:31: joint 'turn' holds solid 'box', which lies outside of the domain"));
    }
  }
}

TEST_CASE("joints: one that is far from its body is told", "[joints]") {
  for (const double at : {1.0, 3.0}) {
    Scene s = one_box("0");
    s.joints[0].at = Vec3(at, 0, 0);
    const std::vector<std::string> told = make_simulation(s, Communicator())->take_warnings();
    const bool any = std::any_of(told.begin(), told.end(), [](const std::string& line) {
      return line.find("joint 'turn' is 17 times the size of its solids away") != std::string::npos;
    });
    CHECK(any == (at > 2));
  }
}

TEST_CASE("joints: a drive that ends is named with the time", "[joints]") {
  check_stopped(one_box("90*t+0*sqrt(0.3-t)"), "not finite between t =");
}

}  // namespace joints_refused_tests
