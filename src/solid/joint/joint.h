#pragma once
// Joints between two rigid motions: constraints and coordinates with their rates.
#include <array>
#include <optional>
#include <vector>

#include "base/joint_spec.h"
#include "solid/body/body.h"

namespace seiche {

// Row of the table of joint kinds. Axes of a joint: z is its axis, fixed to the first body.
struct JointKindRow {
  JointKind kind;
  const char* name;
  const char* doc;
};
const std::array<JointKindRow, 10>& joint_kinds();
const char* name_of(JointKind kind);

// Measure of a joint's coordinate q: the turn of the first body against the second, rad, or a length, m.
enum class JointCoordinate : char { none, turn, slide, length };
JointCoordinate coordinate_of(JointKind kind);

// Anchor and axes of a joint, fixed to a body that is in its place at t = 0.
struct JointFrame {
  Vec3 anchor{0, 0, 0};                                // m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns x, y, z
};

// Frames of a joint in both bodies.
struct JointFrames {
  JointFrame first, second;
  double length = 0;  // of a distance, m
};
JointFrames joint_frames(const JointSpec& spec, int dimension);

// A value g of the poses of both bodies, and its rate first.(v, w) + second.(v', w') by the velocities at the reference
// points and the angular velocities. A constraint is g = 0.
struct JointRow {
  double value = 0;  // m, or rad
  Eigen::Matrix<double, 6, 1> first = Eigen::Matrix<double, 6, 1>::Zero(), second = first;
};

// Pose of a body, and the point in space that its velocity belongs to.
struct JointedBody {
  Pose pose;
  Vec3 about{0, 0, 0};
};

// The constraints of a joint in these places of its bodies (not of a gear). Rates of a slider and its like are exact
// for any slide; impulses along the rows are equal and opposite at one point, so that momenta are kept.
std::vector<JointRow> joint_constraints(JointKind kind, int dimension, const JointFrames& frames,
                                        const JointedBody& first, const JointedBody& second);

// The coordinate, turns from -pi to pi. Only if the kind has one.
JointRow joint_coordinate(JointKind kind, const JointFrames& frames, const JointedBody& first,
                          const JointedBody& second);

}  // namespace seiche
