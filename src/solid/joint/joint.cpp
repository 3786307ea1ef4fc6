#include "solid/joint/joint.h"

#include <cmath>

namespace seiche {
namespace {

// Motions that a constraint holds: of a point along the axes of space, else along and about the axes x, y, z of the
// joint.
enum class Held : char {
  point_x,
  point_y,
  point_z,
  along_x,
  along_y,
  along_z,
  turn_x,
  turn_y,
  turn_z,
  crossed,
  length
};

// Constraints of a kind. 2D: along two axes of the plane and about its normal: z, or y where the axis lies in the
// plane.
struct HeldRow {
  JointKind kind;
  std::vector<Held> in_3d, in_2d;
};

const std::vector<Held>& held_by(JointKind kind, int dimension) {
  using enum Held;
  using K = JointKind;
  static const std::array<HeldRow, 10> table{{
      {K::weld, {point_x, point_y, point_z, turn_x, turn_y, turn_z}, {point_x, point_y, turn_z}},
      {K::hinge, {point_x, point_y, point_z, turn_x, turn_y}, {point_x, point_y}},
      {K::ball, {point_x, point_y, point_z}, {}},
      {K::slider, {along_x, along_y, turn_x, turn_y, turn_z}, {along_x, turn_y}},
      {K::cylindrical, {along_x, along_y, turn_x, turn_y}, {}},
      {K::universal, {point_x, point_y, point_z, crossed}, {}},
      {K::planar, {along_z, turn_x, turn_y}, {}},
      {K::distance, {length}, {length}},
      {K::rope, {}, {}},
      {K::gear, {}, {}},
  }};
  const HeldRow& row = table[std::size_t(kind)];
  return dimension == 2 ? row.in_2d : row.in_3d;
}

// Both frames in space.
struct Places {
  Vec3 first, second, from_first, from_second;  // anchors; arms from the reference points to the second anchor
  Eigen::Matrix3d axes, other;
};

Places placed(const JointFrames& frames, const JointedBody& first, const JointedBody& second) {
  const Vec3 a = first.pose.apply(frames.first.anchor), b = second.pose.apply(frames.second.anchor);
  return {a,
          b,
          b - first.about,
          b - second.about,
          first.pose.rotation * frames.first.axes,
          second.pose.rotation * frames.second.axes};
}

// d.(a - b) for a direction d of space or of the first body: both bodies feel the force at the point b.
JointRow along(const Places& p, const Vec3& d) {
  JointRow row{d.dot(p.first - p.second), {}, {}};
  row.first << d, p.from_first.cross(d);
  row.second << -d, -p.from_second.cross(d);
  return row;
}

// u.w for a direction u of the first body and w of the second: rate (u x w).(omega - omega').
JointRow across(const Vec3& u, const Vec3& w) {
  JointRow row{u.dot(w), {}, {}};
  row.first << Vec3::Zero(), u.cross(w);
  row.second << Vec3::Zero(), -u.cross(w);
  return row;
}

// |a - b| - length, along the line between both.
JointRow apart(const Places& p, double length) {
  const Vec3 way = p.first - p.second;
  const double far = way.norm();
  const Vec3 d = far > 0 ? Vec3(way / far) : Vec3(p.axes.col(0));
  JointRow row = along(p, d);
  row.value = far - length;
  return row;
}

JointRow held_row(Held held, const Places& p, double length) {
  const Vec3 x = p.axes.col(0), y = p.axes.col(1), z = p.axes.col(2);
  switch (held) {
    case Held::point_x:
      return along(p, Vec3::UnitX());
    case Held::point_y:
      return along(p, Vec3::UnitY());
    case Held::point_z:
      return along(p, Vec3::UnitZ());
    case Held::along_x:
      return along(p, x);
    case Held::along_y:
      return along(p, y);
    case Held::along_z:
      return along(p, z);
    case Held::turn_x:
      return across(y, p.other.col(2));
    case Held::turn_y:
      return across(x, p.other.col(2));
    case Held::turn_z:
      return across(x, p.other.col(1));
    case Held::crossed:
      return across(z, p.other.col(1));
    case Held::length:
      return apart(p, length);
  }
  return {};
}

// Axes with z along the given one. x is perpendicular: in the plane in 2D, else near the coordinate axis that z is
// farthest from.
Eigen::Matrix3d axes_about(const Vec3& axis, int dimension) {
  Eigen::Matrix3d axes;
  axes.col(2) = axis.normalized();
  Eigen::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  const Vec3 near = dimension == 2 && axis[2] == 0 ? Vec3(axis[1], -axis[0], 0) : Vec3(Vec3::Unit(least));
  axes.col(0) = (near - near.dot(axes.col(2)) * axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

}  // namespace

const std::array<JointKindRow, 10>& joint_kinds() {
  using K = JointKind;
  static const std::array<JointKindRow, 10> table{{
      {K::weld, "weld", "holds both together"},
      {K::hinge, "hinge", "lets them turn about an axis"},
      {K::ball, "ball", "lets them turn about a point (3D)"},
      {K::slider, "slider", "lets them slide along an axis"},
      {K::cylindrical, "cylindrical", "lets them slide along an axis and turn about it (3D)"},
      {K::universal, "universal", "lets them turn about two crossed axes, one fixed to each (3D)"},
      {K::planar, "planar", "lets them slide on a plane and turn about its normal, the axis (3D)"},
      {K::distance, "distance",
       "keeps two points apart, as a massless rod; a strut where a spring, motor, drive or "
       "limits act along it"},
      {K::rope, "rope", "keeps two points from going farther apart than its length"},
      {K::gear, "gear", "keeps the coordinates of two joints in a ratio"},
  }};
  return table;
}

const char* name_of(JointKind kind) {
  return joint_kinds()[std::size_t(kind)].name;
}

JointCoordinate coordinate_of(JointKind kind) {
  switch (kind) {
    case JointKind::hinge:
      return JointCoordinate::turn;
    case JointKind::slider:
    case JointKind::cylindrical:
      return JointCoordinate::slide;
    case JointKind::distance:
    case JointKind::rope:
      return JointCoordinate::length;
    default:
      return JointCoordinate::none;
  }
}

JointFrames joint_frames(const JointSpec& spec, int dimension) {
  JointFrames frames;
  const bool has_axis = !spec.axis.isZero(0);
  frames.first.anchor = frames.second.anchor = spec.at;
  frames.first.axes = axes_about(has_axis ? spec.axis : Vec3::UnitZ(), dimension);
  frames.second.axes = frames.first.axes;
  if (spec.kind == JointKind::universal) {
    // Perpendicular beyond the scene's decimals, so that it is closed at the start.
    const Vec3 z = frames.second.axes.col(2);
    frames.second.axes.col(1) = (spec.second - spec.second.dot(z) * z).normalized();
    frames.second.axes.col(0) = frames.second.axes.col(1).cross(frames.second.axes.col(2));
  }
  if (coordinate_of(spec.kind) == JointCoordinate::length) {
    frames.second.anchor = spec.to;
    frames.length = (spec.at - spec.to).norm();
  }
  return frames;
}

std::vector<JointRow> joint_constraints(JointKind kind, int dimension, const JointFrames& frames,
                                        const JointedBody& first, const JointedBody& second) {
  const Places places = placed(frames, first, second);
  std::vector<JointRow> rows;
  rows.reserve(held_by(kind, dimension).size());
  for (const Held held : held_by(kind, dimension)) rows.push_back(held_row(held, places, frames.length));
  return rows;
}

JointRow joint_coordinate(JointKind kind, const JointFrames& frames, const JointedBody& first,
                          const JointedBody& second) {
  const Places p = placed(frames, first, second);
  if (coordinate_of(kind) == JointCoordinate::slide) return along(p, p.axes.col(2));
  if (coordinate_of(kind) == JointCoordinate::length) return apart(p, 0);
  const Vec3 x = p.axes.col(0), z = p.other.col(2);
  JointRow row;
  row.value = std::atan2(p.other.col(1).dot(x), p.other.col(0).dot(x));
  row.first << Vec3::Zero(), z;
  row.second << Vec3::Zero(), -z;
  return row;
}

}  // namespace seiche
