// Keys of [[robot]].
#include <algorithm>

#include "base/robot_spec.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

// Forces as of a [[joint]]; the file has the kinds.
std::vector<Key<RobotJointSpec>> forces_of_robot_joint() {
  Section<JointSpec> own;
  for (Key<JointSpec>& key : joint_section().keys) {
    static const std::vector<std::string> kept{"limits",    "spring",   "motor",  "drive",
                                               "breaks_at", "friction", "radius", "collide"};
    if (std::find(kept.begin(), kept.end(), key.option.key) == kept.end()) continue;
    key.option.only_for = {};
    own.keys.push_back(std::move(key));
  }
  return lift<RobotJointSpec>(own, &RobotJointSpec::forces);
}

Section<RobotJointSpec> robot_joint_section() {
  Section<RobotJointSpec> s;
  s.keys = {value_key<RobotJointSpec>(
                {.key = "name", .type = T::text, .presence = Presence::required, .doc = "the joint's name in the file"},
                &RobotJointSpec::name),
            value_key<RobotJointSpec>({.key = "start",
                                       .unit = "degrees or m",
                                       .range = any_number(),
                                       .doc = "its angle or slide at t = 0, by the file's zero"},
                                      &RobotJointSpec::start)};
  for (Key<RobotJointSpec>& key : forces_of_robot_joint()) s.keys.push_back(std::move(key));
  s.finish = [](SceneContext& c, const Place& p, RobotJointSpec& joint) { joint.forces.where = c.where(p.node->line); };
  return s;
}

}  // namespace

Section<RobotSpec> robot_section() {
  using S = RobotSpec;
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "name",
                    .type = T::text,
                    .unset = "`robot1`, `robot2`, ...",
                    .doc = "begins the names of its solids and joints: `name/link`, `name/joint`"},
                   &S::name),
      value_key<S>({.key = "file", .type = T::file, .presence = Presence::required, .doc = "the robot, in URDF"},
                   &S::file),
      choice_key<S, RobotBase S::*, RobotBase>({.key = "base", .doc = "whether the root link stands fixed in space"},
                                               &S::base, {{"free", RobotBase::free}, {"fixed", RobotBase::fixed}}),
      value_key<S>({.key = "density",
                    .unit = "kg/m^3",
                    .range = positive(),
                    .unset = "all links have a mass in the file",
                    .doc = "density of links to which the file gives no mass"},
                   &S::density)};
  for (Key<S>& key : lift<S>(placement_section(), &S::transform)) s.keys.push_back(std::move(key));
  s.keys.push_back(list_key<S, RobotJointSpec>({.key = "joint",
                                                .unset = "as in the file",
                                                .doc = "forces on joints of the file, and where they start",
                                                .most = most_entries},
                                               &S::joints, robot_joint_section()));
  s.finish = [](SceneContext& c, const Place& p, S& robot) { robot.where = c.where(p.node->line); };
  return s;
}

}  // namespace seiche
