// Joints that contradict each other in motion, and formulas that end, stop the run with the joint's name.
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

TEST_CASE("joints: a drive that ends is named with the time", "[joints]") {
  check_stopped(one_box("90*t+0*sqrt(0.3-t)"), "not finite between t =");
}

}  // namespace joints_refused_tests
