// Keys of [[joint]].
#include <fmt/format.h>

#include "base/joint_spec.h"
#include "scene/options.h"
#include "solid/joint/joint.h"

namespace seiche {
namespace {

using T = OptionType;

const Range from_zero = between(0, number_limit);
const Condition with_coordinate{"kind", {"hinge", "slider", "cylindrical", "distance"}};

Key<JointSpec> joint_kind_key() {
  std::string doc;
  std::vector<std::pair<std::string, JointKind>> names;
  for (const JointKindRow& row : joint_kinds()) {
    doc += fmt::format("{}{}: {}", doc.empty() ? "" : "; ", row.name, row.doc);
    names.emplace_back(row.name, row.kind);
  }
  return choice_key<JointSpec, JointKind JointSpec::*, JointKind>(
      {.key = "kind", .presence = Presence::required, .doc = doc}, &JointSpec::kind, names);
}

Section<JointSpringSpec> joint_spring_section() {
  using P = JointSpringSpec;
  Section<P> s;
  s.keys = {
      value_key<P>({.key = "stiffness",
                    .unit = "N m/rad or N/m",
                    .range = from_zero,
                    .doc = "torque over angle, or force over length; 2D: per metre of depth"},
                   &P::stiffness),
      value_key<P>({.key = "damping",
                    .unit = "N m s/rad or N s/m",
                    .range = from_zero,
                    .doc = "torque or force over rate; 2D: per metre of depth"},
                   &P::damping),
      value_key<P>({.key = "rest", .unit = "degrees or m", .unset = "as at the start", .doc = "where it is slack"},
                   &P::rest),
  };
  return s;
}

// Keys of a motor's goal.
std::vector<Key<JointMotorSpec>> joint_goal_keys() {
  using P = JointMotorSpec;
  return {
      value_key<P>({.key = "speed",
                    .type = T::formula,
                    .unit = "rad/s or m/s",
                    .variables = "t",
                    .unset = "the motor has a target",
                    .doc = "rate that it drives the joint at, as a function of t; with torque or force"},
                   &P::speed),
      value_key<P>({.key = "target",
                    .type = T::formula,
                    .unit = "degrees or m",
                    .variables = "t",
                    .unset = "the motor has a speed",
                    .doc = "where it drives the joint to, from its place at the start, as a function of t"},
                   &P::target),
      value_key<P>({.key = "stiffness",
                    .unit = "N m/rad or N/m",
                    .range = from_zero,
                    .doc = "torque or force over the distance from the target"},
                   &P::stiffness),
      value_key<P>({.key = "damping",
                    .unit = "N m s/rad or N s/m",
                    .range = from_zero,
                    .doc = "torque or force over the rate by which the joint differs from the target's"},
                   &P::damping),
  };
}

void check_motor(SceneContext& c, const Place& p, const JointMotorSpec& motor) {
  if (motor.speed.has_value() == motor.target.has_value())
    c.report(p, p.path + ": a motor has either a speed or a target");
  if (motor.speed && !motor.most())
    c.report(p, p.path +
                    ": a motor with a speed needs its largest torque (hinge) or force; for an exact motion give "
                    "drive instead");
  if (motor.target && motor.stiffness == 0 && motor.damping == 0)
    c.report(p, p.path + ": a motor with a target needs stiffness or damping");
}

Section<JointMotorSpec> joint_motor_section() {
  using P = JointMotorSpec;
  Section<P> s;
  s.keys = joint_goal_keys();
  s.keys.push_back(value_key<P>({.key = "torque",
                                 .unit = "N m",
                                 .range = positive(),
                                 .unset = "no limit",
                                 .doc = "largest torque, of a hinge; 2D: per metre of depth"},
                                &P::torque));
  s.keys.push_back(value_key<P>({.key = "force",
                                 .unit = "N",
                                 .range = positive(),
                                 .unset = "no limit",
                                 .doc = "largest force, of other joints; 2D: per metre of depth"},
                                &P::force));
  s.finish = [](SceneContext& c, const Place& p, P& motor) { check_motor(c, p, motor); };
  return s;
}

Section<JointDriveSpec> joint_drive_section() {
  using P = JointDriveSpec;
  Section<P> s;
  s.keys = {
      value_key<P>({.key = "degrees",
                    .type = T::formula,
                    .unit = "degrees",
                    .variables = "t",
                    .unset = "translate is given",
                    .doc = "angle of a hinge as a function of t, 0 at the start"},
                   &P::degrees),
      value_key<P>({.key = "translate",
                    .type = T::formula,
                    .unit = "m",
                    .variables = "t",
                    .unset = "degrees is given",
                    .doc = "way of other joints as a function of t, 0 at the start"},
                   &P::translate),
  };
  s.finish = [](SceneContext& c, const Place& p, P& drive) {
    if (drive.degrees.has_value() == drive.translate.has_value())
      c.report(p, p.path + ": a drive has either degrees (hinge) or translate");
  };
  return s;
}

Section<JointBreakSpec> joint_break_section() {
  using P = JointBreakSpec;
  Section<P> s;
  s.keys = {
      value_key<P>(
          {.key = "force", .unit = "N", .range = positive(), .unset = "no limit", .doc = "force that it bears"},
          &P::force),
      value_key<P>(
          {.key = "torque", .unit = "N m", .range = positive(), .unset = "no limit", .doc = "torque that it bears"},
          &P::torque),
  };
  return s;
}

std::vector<Key<JointSpec>> joint_point_keys() {
  const Condition placed{"kind",
                         {"weld", "hinge", "ball", "slider", "cylindrical", "universal", "planar", "distance", "rope"}};
  const Condition apart{"kind", {"distance", "rope"}};
  return {
      value_key<JointSpec>({.key = "at",
                            .type = T::vector,
                            .unit = "m",
                            .only_for = placed,
                            .presence = Presence::required,
                            .doc = "where it is at t = 0; distance, rope: its end at the first solid"},
                           &JointSpec::at),
      value_key<JointSpec>({.key = "to",
                            .type = T::vector,
                            .unit = "m",
                            .only_for = apart,
                            .presence = Presence::required,
                            .doc = "its end at the second solid at t = 0"},
                           &JointSpec::to),
  };
}

std::vector<Key<JointSpec>> joint_axis_keys() {
  return {
      value_key<JointSpec>({.key = "axis",
                            .type = T::axis,
                            .only_for = {"kind", {"hinge", "slider", "cylindrical", "universal", "planar"}},
                            .unset = "along z in a hinge in 2D; all others must give it",
                            .doc = "axis of the joint, fixed to the first solid"},
                           &JointSpec::axis),
      value_key<JointSpec>({.key = "second_axis",
                            .type = T::axis,
                            .only_for = {"kind", {"universal"}},
                            .presence = Presence::required,
                            .doc = "the other axis, perpendicular, fixed to the second solid"},
                           &JointSpec::second),
      value_key<JointSpec>(
          {.key = "ratio",
           .range = any_number(),
           .only_for = {"kind", {"gear"}},
           .presence = Presence::required,
           .doc = "way of the first joint over that of the second, in rad and m; negative: against each other"},
          &JointSpec::ratio),
      value_key<JointSpec>({.key = "length",
                            .unit = "m",
                            .range = positive(),
                            .only_for = {"kind", {"rope"}},
                            .unset = "the distance from at to to",
                            .doc = "length of the rope"},
                           &JointSpec::length),
  };
}

std::vector<Key<JointSpec>> joint_force_keys() {
  return {
      value_key<JointSpec>(
          {.key = "limits",
           .type = T::interval,
           .unit = "degrees or m",
           .only_for = with_coordinate,
           .unset = "none",
           .doc = "least and largest coordinate: angle and slide are 0 at the start, a distance is its length"},
          &JointSpec::limits),
      optional_table_key<JointSpec, JointSpringSpec>({.key = "spring",
                                                      .only_for = with_coordinate,
                                                      .unset = "none",
                                                      .doc = "spring and damper along the coordinate"},
                                                     &JointSpec::spring, joint_spring_section()),
      optional_table_key<JointSpec, JointMotorSpec>(
          {.key = "motor",
           .only_for = with_coordinate,
           .unset = "none",
           .doc = "drives the joint with a limited torque or force, or to a target"},
          &JointSpec::motor, joint_motor_section()),
      optional_table_key<JointSpec, JointDriveSpec>({.key = "drive",
                                                     .only_for = with_coordinate,
                                                     .unset = "none",
                                                     .doc = "prescribes the coordinate exactly, whatever that takes"},
                                                    &JointSpec::drive, joint_drive_section()),
  };
}

std::vector<Key<JointSpec>> joint_loss_keys() {
  return {
      optional_table_key<JointSpec, JointBreakSpec>(
          {.key = "breaks_at",
           .only_for = {"kind", {"weld", "hinge", "ball", "slider", "cylindrical", "universal", "planar", "distance"}},
           .unset = "never",
           .doc = "load at which it breaks, for good"},
          &JointSpec::breaks_at, joint_break_section()),
      value_key<JointSpec>({.key = "friction",
                            .range = from_zero,
                            .only_for = with_coordinate,
                            .unset = "none",
                            .doc = "Coulomb's coefficient, with the load that the joint bears"},
                           &JointSpec::friction),
      value_key<JointSpec>({.key = "radius",
                            .unit = "m",
                            .range = positive(),
                            .only_for = {"kind", {"hinge"}},
                            .unset = "no friction",
                            .doc = "radius of the pin, at which friction acts"},
                           &JointSpec::radius),
  };
}

Section<ShapeSpec> joint_region_section() {
  Section<ShapeSpec> s = shape_section();
  s.finish = [](SceneContext& c, const Place& p, ShapeSpec& shape) { finish_shape(c, p, shape); };
  return s;
}

std::vector<Key<JointSpec>> joint_region_keys() {
  const Condition placed{"kind",
                         {"weld", "hinge", "ball", "slider", "cylindrical", "universal", "planar", "distance", "rope"}};
  return {
      optional_table_key<JointSpec, ShapeSpec>(
          {.key = "region",
           .only_for = placed,
           .unset = "required where one of the solids is elastic",
           .doc = "a shape: the joint holds the mean place and rotation of an elastic solid's nodes that lie in it at "
                  "rest"},
          &JointSpec::region, joint_region_section()),
      optional_table_key<JointSpec, ShapeSpec>(
          {.key = "second_region", .only_for = placed, .unset = "as region", .doc = "the same for the second solid"},
          &JointSpec::second_region, joint_region_section()),
  };
}

}  // namespace

Section<JointSpec> joint_section() {
  Section<JointSpec> s;
  s.keys = {
      value_key<JointSpec>({.key = "name", .type = T::text, .unset = "`joint1`, `joint2`, ...", .doc = "unique name"},
                           &JointSpec::name),
      joint_kind_key(),
      value_key<JointSpec>(
          {.key = "between",
           .type = T::pair,
           .presence = Presence::required,
           .doc = "the two solids that it joins, one of which may be \"world\"; a gear: two joints. Loads, "
                  "angles and ways are those of the first against the second"},
          &JointSpec::between)};
  for (const auto& keys :
       {joint_point_keys(), joint_axis_keys(), joint_force_keys(), joint_loss_keys(), joint_region_keys()})
    s.keys.insert(s.keys.end(), keys.begin(), keys.end());
  s.keys.push_back(value_key<JointSpec>(
      {.key = "collide", .type = T::boolean, .doc = "whether the two solids touch each other where they meet"},
      &JointSpec::collide));
  s.finish = [](SceneContext& c, const Place& p, JointSpec& joint) { joint.where = c.where(p.node->line); };
  return s;
}

}  // namespace seiche
