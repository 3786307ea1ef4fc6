// Keys of [[solid]] for rigid solids.
#include <fmt/format.h>

#include <algorithm>

#include "base/shape_spec.h"
#include "base/solid_spec.h"
#include "coupling/solids/solid_kinds.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;
using Names = std::vector<std::string>;
using Axes = std::array<bool, 3>;

const std::string turning = "rotation";

std::string axis_name(int axis) {
  return std::string(1, "xyz"[axis]);
}

bool all(const Axes& axes) {
  return std::all_of(axes.begin(), axes.end(), [](bool held) { return held; });
}

bool lists(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Permitted values of `fixed`; in 2D rotation is about z only.
Names fixed_names(int dimension) {
  Names names;
  for (int axis = 0; axis < dimension; ++axis) names.push_back(axis_name(axis));
  names.push_back(turning);
  for (int axis = 0; axis < 3 && dimension == 3; ++axis) names.push_back(turning + "_" + axis_name(axis));
  return names;
}

void read_fixed(SceneContext& c, const Place& p, Option option, RigidSpec& rigid) {
  if (c.dimension == 2) option.choices = fixed_names(2);
  Names names;
  read_value(c, p, option, names);
  for (const std::string& name : names) {
    if (name == turning || !name.starts_with(turning) || !lists(names, turning)) continue;
    c.report(p, fmt::format("{} lists \"{}\" twice: \"{}\" means all axes", p.path, name, turning));
  }
  if (!c.clean(p.path)) return;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name = axis_name(int(axis));
    rigid.fixed_position[axis] = lists(names, name);
    rigid.fixed_rotation[axis] = lists(names, turning) || lists(names, turning + "_" + name);
  }
}

Names names_of(const RigidSpec& rigid) {
  Names names;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (rigid.fixed_position[axis]) names.push_back(axis_name(int(axis)));
  }
  if (all(rigid.fixed_rotation)) names.push_back(turning);
  for (std::size_t axis = 0; axis < 3 && !all(rigid.fixed_rotation); ++axis) {
    if (rigid.fixed_rotation[axis]) names.push_back(turning + "_" + axis_name(int(axis)));
  }
  return names;
}

Key<RigidSpec> fixed_key() {
  const Option option{.key = "fixed",
                      .type = T::choice_list,
                      .choices = fixed_names(3),
                      .only_for = {"kind", {"rigid"}},
                      .unset = "free to move",
                      .doc =
                          "degrees of freedom that do not move: the centre of mass along an axis, rotation about all "
                          "axes or one; all but one rotation make a hinge; 2D: x, y, rotation"};
  Key<RigidSpec> key{option, {}, {}};
  key.read = [option](SceneContext& c, const Place& p, RigidSpec& rigid) { read_fixed(c, p, option, rigid); };
  key.write = [option](const RigidSpec& rigid, int dimension, const std::string& path, SceneLines& lines) {
    lines.push_back({join_path(path, option.key), option.key, to_toml(names_of(rigid), option, dimension)});
  };
  return key;
}

// Names of the kinds of solids with this property.
template <class Holds>
Names names_of_kinds(const Holds& holds) {
  Names names;
  for (const SolidKindRow& row : solid_kinds())
    if (holds(row.kind)) names.push_back(row.kind.name);
  return names;
}

// Reports a velocity along or about a fixed axis.
void check_held(SceneContext& c, const Place& p, const std::string& key, const Vec3& velocity, const Axes& held) {
  for (int axis = 0; axis < 3; ++axis) {
    if (velocity[axis] == 0 || !held[std::size_t(axis)]) continue;
    const std::string path = join_path(p.path, key);
    c.report(path, p.node->find(key)->value.line,
             fmt::format("{0} is {1} for {2}, but fixed includes {2}; set the velocity to 0 or remove {2} from fixed",
                         path, velocity[axis], axis_name(axis)));
  }
}

}  // namespace

Section<RigidSpec> rigid_section() {
  using S = RigidSpec;
  const Condition moved{"kind", names_of_kinds([](const SolidKind& k) { return k.is_free(); })};
  const Condition turned{"kind", names_of_kinds([](const SolidKind& k) { return k.is_free() && k.may_turn; })};
  Section<S> s;
  s.keys = {
      value_key<S>({.key = "density",
                    .unit = "kg/m^3",
                    .range = positive(),
                    .only_for = moved,
                    .presence = Presence::required,
                    .doc = "density, the same throughout the solid"},
                   &S::density),
      value_key<S>({.key = "velocity",
                    .type = T::vector,
                    .unit = "m/s",
                    .only_for = moved,
                    .unset = "at rest",
                    .doc = "initial velocity of the centre of mass"},
                   &S::velocity),
      value_key<S>({.key = "angular_velocity",
                    .type = T::spin,
                    .unit = "rad/s",
                    .only_for = turned,
                    .unset = "no rotation",
                    .doc = "initial rate of rotation about the centre of mass; in 2D a number, counter-clockwise"},
                   &S::angular_velocity),
      fixed_key(),
  };
  return s;
}

void check_bounded(SceneContext& c, const Place& p, const ShapeSpec& shape, const std::string& what) {
  const std::string subject = what + " must be bounded: ", remedy = ", or make the solid static";
  if (shape.kind == "plane") c.report(p, subject + "a plane is not; write it as a box" + remedy);
  if (shape.invert) {
    c.report(p, subject +
                    "an inverted shape is not; write a hollow body as an expression (phi = \"max(outer, "
                    "-inner)\") or a mesh" +
                    remedy);
  }
}

void finish_rigid(SceneContext& c, const Place& p, const SolidSpec& solid) {
  check_bounded(c, p, solid.shape, fmt::format("a {} solid", solid.kind.name));
  check_held(c, p, "velocity", solid.rigid.velocity, solid.rigid.fixed_position);
  check_held(c, p, "angular_velocity", solid.rigid.angular_velocity, solid.rigid.fixed_rotation);
}

}  // namespace seiche
