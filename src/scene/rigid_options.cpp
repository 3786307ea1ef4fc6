// Keys of [[solid]] for rigid solids.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
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

// Written where the solid has one, and no mass instead.
Key<RigidSpec> density_key(const Condition& moved) {
  Key<RigidSpec> key = value_key<RigidSpec>({.key = "density",
                                             .unit = "kg/m^3",
                                             .range = positive(),
                                             .only_for = moved,
                                             .unset = "mass is given",
                                             .doc = "density, the same throughout the solid"},
                                            &RigidSpec::density);
  key.write = [write = key.write](const RigidSpec& rigid, int dimension, const std::string& path, SceneLines& lines) {
    if (rigid.density > 0) write(rigid, dimension, path, lines);
  };
  return key;
}

// Mass properties in place of those of a shape of one density.
std::vector<Key<RigidSpec>> mass_keys(const Condition& turned) {
  using S = RigidSpec;
  return {
      value_key<S>({.key = "mass",
                    .unit = "kg",
                    .range = positive(),
                    .only_for = turned,
                    .unset = "density times volume",
                    .doc = "mass in place of density; 2D: per metre of depth"},
                   &S::mass),
      value_key<S>({.key = "center_of_mass",
                    .type = T::vector,
                    .unit = "m",
                    .only_for = turned,
                    .unset = "that of the shape",
                    .doc = "centre of mass at t = 0"},
                   &S::center_of_mass),
      value_key<S>(
          {.key = "inertia",
           .type = T::spin,
           .unit = "kg m^2",
           .only_for = turned,
           .unset = "that of the shape at one density",
           .doc = "moments of inertia I_xx, I_yy, I_zz about the centre of mass, by the axes of space at t = 0; "
                  "in 2D a number"},
          &S::inertia),
      value_key<S>({.key = "products_of_inertia",
                    .type = T::axis,
                    .unit = "kg m^2",
                    .only_for = turned,
                    .unset = "zero",
                    .doc = "I_xy, I_xz, I_yz of the tensor of inertia, with inertia (3D)"},
                   &S::products_of_inertia),
  };
}

}  // namespace

Section<RigidSpec> rigid_section() {
  using S = RigidSpec;
  const Condition moved{"kind", names_of_kinds([](const SolidKind& k) { return k.is_free(); })};
  const Condition turned{"kind", names_of_kinds([](const SolidKind& k) { return k.is_free() && k.may_turn; })};
  Section<S> s;
  s.keys = {
      density_key(moved),
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
  for (Key<S>& key : mass_keys(turned)) s.keys.push_back(std::move(key));
  return s;
}

void check_bounded(SceneContext& c, const Place& p, const ShapeSpec& shape, const std::string& what) {
  const std::string subject = what + " must be bounded: ", remedy = ", or make the solid static";
  if (shape.kind == "plane") c.report(p, subject + "a plane is not; write it as a box" + remedy);
  if (shape.kind == "height_map") c.report(p, subject + "a height_map is not; give a closed mesh" + remedy);
  if (shape.invert) {
    c.report(p, subject +
                    "an inverted shape is not; write a hollow body as an expression (phi = \"max(outer, "
                    "-inner)\") or a mesh" +
                    remedy);
  }
}

std::string fault_of_inertia(const Eigen::Matrix3d& tensor) {
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor).eigenvalues();
  constexpr double rounding = 1e-3;  // tables of robots give few decimals
  if (principal[0] > 0 && principal[0] + principal[1] >= (1 - rounding) * principal[2]) return {};
  return fmt::format(
      "no body has principal moments of {:.4g}, {:.4g} and {:.4g} kg m^2: each must be above 0 and at most the sum of "
      "the others",
      principal[0], principal[1], principal[2]);
}

void check_mass(SceneContext& c, const Place& p, const SolidSpec& solid) {
  const RigidSpec& r = solid.rigid;
  if (r.mass && r.density > 0) c.report(p, p.path + " has both density and mass; give one of them");
  if (!r.mass && r.density == 0)
    c.report(p, fmt::format("{} needs 'density' with kind = \"{}\" (kg/m^3){}", section_title(p.path), solid.kind.name,
                            solid.kind.has_elements ? "" : ", or 'mass' (kg)"));
  if (r.products_of_inertia && (!r.inertia || c.dimension == 2))
    c.report(p, join_path(p.path, "products_of_inertia") +
                    (c.dimension == 2 ? " exist in 3D only" : " need inertia beside them"));
  if (!r.inertia || !c.clean(p.path)) return;
  const Vec3 m = *r.inertia, products = r.products_of_inertia.value_or(Vec3(0, 0, 0));
  if (c.dimension == 2) {
    if (!(m[2] > 0)) c.report(p, join_path(p.path, "inertia") + " must be above 0");
    return;
  }
  Eigen::Matrix3d tensor = m.asDiagonal();
  tensor(1, 0) = products[0], tensor(2, 0) = products[1], tensor(2, 1) = products[2];
  const std::string fault = fault_of_inertia(tensor);
  if (!fault.empty()) c.report(p, join_path(p.path, "inertia") + ": " + fault);
}

void finish_rigid(SceneContext& c, const Place& p, const SolidSpec& solid) {
  check_mass(c, p, solid);
  check_bounded(c, p, solid.shape, fmt::format("a {} solid", solid.kind.name));
  check_held(c, p, "velocity", solid.rigid.velocity, solid.rigid.fixed_position);
  check_held(c, p, "angular_velocity", solid.rigid.angular_velocity, solid.rigid.fixed_rotation);
}

}  // namespace seiche
