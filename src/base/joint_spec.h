#pragma once
// A [[joint]] of a scene. Plain data in SI units; angles in degrees, as in the scene.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/formula.h"
#include "base/shape_spec.h"
#include "base/vec.h"

namespace seiche {

enum class JointKind : char { weld, hinge, ball, slider, cylindrical, universal, planar, distance, rope, gear };

// Force -k (q - rest) - c dq/dt along the joint's coordinate q, or its moment.
struct JointSpringSpec {
  double stiffness = 0, damping = 0;  // N/m and N s/m, or N m/rad and N m s/rad; 2D: per metre of depth
  std::optional<double> rest;         // degrees or m; unset: as at the start
};

// A motor drives dq/dt to `speed`, or q to `target`.
struct JointMotorSpec {
  std::optional<Formula> speed, target;  // rad/s or m/s; degrees or m
  double stiffness = 0, damping = 0;     // of a target
  std::optional<double> torque, force;   // its largest, N m or N; unset: no limit
  std::optional<double> most() const { return torque ? torque : force; }
};

// Prescribed coordinate, from 0 at the start.
struct JointDriveSpec {
  std::optional<Formula> degrees, translate;  // degrees, m
};

struct JointBreakSpec {
  std::optional<double> force, torque;  // N, N m
};

struct JointSpec {
  std::string name;
  JointKind kind = JointKind::hinge;
  std::vector<std::string> between;     // two solids, or "world" for one of them; a gear: two joints
  Vec3 at{0, 0, 0}, to{0, 0, 0};        // m; `to`: the end at the second solid, of a distance or a rope
  Vec3 axis{0, 0, 0}, second{0, 0, 0};  // as given; zero: not given
  double ratio = 1;                     // of a gear
  std::optional<double> length;         // of a rope, m; unset: from `at` to `to`
  std::optional<std::array<double, 2>> limits;
  std::optional<JointSpringSpec> spring;
  std::optional<JointMotorSpec> motor;
  std::optional<JointDriveSpec> drive;
  std::optional<JointBreakSpec> breaks_at;
  double friction = 0;           // coefficient
  std::optional<double> radius;  // arm of the friction in a hinge, m
  bool collide = false;
  std::optional<ShapeSpec> region, second_region;  // whose nodes of elastic solids it holds; second unset: as region
  std::string where;                               // "scene.toml:14"
};

}  // namespace seiche
