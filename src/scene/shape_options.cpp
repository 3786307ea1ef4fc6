// Keys of shapes: permitted and required ones of each shape.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/shape_spec.h"
#include "scene/options.h"
#include "solid/mesh/file.h"

namespace seiche {
namespace {

using T = OptionType;

const std::vector<std::string> axial{"cylinder", "capsule"};

void set_rotation(const Eigen::Quaterniond& q, RotationSpec& rotation) {
  const Eigen::AngleAxisd turn(q.normalized());
  rotation = {turn.axis(), turn.angle() * 180 / M_PI};
  if (turn.axis().head<2>().norm() == 0 && turn.axis()[2] < 0) rotation = {Vec3::UnitZ(), -rotation.degrees};
}

// Rotations in forms of their own become an axis and an angle, as which they are written.
Key<RotationSpec> form_key(const Option& option,
                           const std::function<void(SceneContext&, const Place&, RotationSpec&)>& read) {
  Key<RotationSpec> key{option, {}, [](const RotationSpec&, int, const std::string&, SceneLines&) {}};
  key.read = read;
  return key;
}

Key<RotationSpec> euler_key() {
  const Option option{.key = "euler",
                      .type = T::axis,
                      .unit = "degrees",
                      .unset = "degrees is given",
                      .doc = "angles about the fixed axes x, then y, then z"};
  return form_key(option, [option](SceneContext& c, const Place& p, RotationSpec& rotation) {
    Vec3 angles = Vec3::Zero();
    read_value(c, p, option, angles);
    angles *= M_PI / 180;
    set_rotation(Eigen::AngleAxisd(angles[2], Vec3::UnitZ()) * Eigen::AngleAxisd(angles[1], Vec3::UnitY()) *
                     Eigen::AngleAxisd(angles[0], Vec3::UnitX()),
                 rotation);
  });
}

Key<RotationSpec> quaternion_key() {
  const Option option{.key = "quaternion",
                      .type = T::quaternion,
                      .unset = "degrees is given",
                      .doc = "four numbers w, x, y, z, of any length"};
  return form_key(option, [option](SceneContext& c, const Place& p, RotationSpec& rotation) {
    if (p.node->kind != TomlNode::Kind::array || p.node->items.size() != 4)
      return c.report(p, p.path + " must be an array of four numbers, w, x, y, z");
    std::array<double, 4> q{};
    const Option number{.key = option.key};
    for (std::size_t n = 0; n < 4; ++n)
      read_value(c, {&p.node->items[n], fmt::format("{}.{}", p.path, n)}, number, q[n]);
    const Eigen::Quaterniond given(q[0], q[1], q[2], q[3]);
    if (!c.clean(p.path)) return;
    if (given.norm() == 0) return c.report(p, p.path + " must not be zero");
    set_rotation(given, rotation);
  });
}

void check_rotation(SceneContext& c, const Place& p, RotationSpec& rotation) {
  int forms = 0;
  for (const char* form : {"degrees", "euler", "quaternion"}) forms += p.node->find(form) != nullptr;
  if (forms != 1)
    return c.report(p, p.path + (forms == 0 ? " is missing the key degrees; or give euler or quaternion"
                                            : ": give one of degrees, euler and quaternion"));
  if (p.node->find("degrees")) return check_axis(c, p, rotation.axis);
  if (p.node->find("axis")) c.report(p, p.path + ": axis goes with degrees");
  if (c.dimension == 2 && rotation.degrees != 0 && rotation.axis.head<2>().norm() > 1e-12)
    c.report(p, p.path + ": a rotation in 2D is about z");
}

Section<RotationSpec> rotation_section() {
  Section<RotationSpec> s;
  s.keys = {
      value_key<RotationSpec>(
          {.key = "axis", .type = T::axis, .doc = "axis through the origin; 3D scenes must give it with degrees"},
          &RotationSpec::axis),
      value_key<RotationSpec>(
          {.key = "degrees", .unit = "degrees", .doc = "angle, counter-clockwise seen against the axis"},
          &RotationSpec::degrees),
      euler_key(),
      quaternion_key(),
  };
  s.finish = check_rotation;
  return s;
}

// A key that is required for the named shapes and forbidden for others.
template <class Member>
Key<ShapeSpec> geometry_key(const std::vector<std::string>& shapes, Option option, Member member) {
  option.only_for = {"shape", shapes};
  option.presence = Presence::required;
  return value_key<ShapeSpec>(option, member);
}

Key<ShapeSpec> point_key(const std::vector<std::string>& shapes, const std::string& name, Vec3 ShapeSpec::*member,
                         const std::string& doc) {
  return geometry_key(shapes, {.key = name, .type = T::vector, .unit = "m", .doc = doc}, member);
}

Key<ShapeSpec> file_key() {
  return geometry_key(
      {"mesh", "level_set", "height_map"},
      {.key = "file",
       .type = T::file,
       .doc = "mesh: closed triangles (.obj, .ply, .stl), in 2D closed outlines (.csv, .txt: x and y of a "
              "point a row, an empty line between outlines; .obj: lines), for elastic solids also "
              "elements (.msh, .vtu, .mesh); level_set: a frame of Seiche (.vdb); height_map: a grey "
              "picture of 8 or 16 bits "
              "(.png), or numbers, a "
              "row a line (.csv, .txt, .asc), as seen from above with the first axis across up to the "
              "right; 2D: one row"},
      &ShapeSpec::file);
}

std::vector<Key<ShapeSpec>> geometry_keys() {
  using S = ShapeSpec;
  return {
      point_key({"box", "height_map"}, "lower", &S::lower,
                "low corner; height_map: of the box that the map fills, from black at its bottom to white at its top, "
                "or with numbers for heights in m along its up; below them is inside, and beyond the box the heights "
                "of its sides go on"),
      point_key({"box", "height_map"}, "upper", &S::upper, "high corner"),
      point_key({"sphere"}, "center", &S::center, "centre of the sphere (2D: disc)"),
      point_key(axial, "from", &S::from, "one end of the axis"),
      point_key(axial, "to", &S::to, "other end of the axis"),
      geometry_key({"sphere", "cylinder", "capsule"},
                   {.key = "radius", .unit = "m", .range = positive(), .doc = "radius"}, &S::radius),
      point_key({"plane"}, "point", &S::point, "a point of the plane"),
      geometry_key({"plane"}, {.key = "normal", .type = T::vector, .doc = "points out of the shape; any length"},
                   &S::normal),
      file_key(),
      geometry_key({"polygon"},
                   {.key = "points",
                    .type = T::points,
                    .unit = "m",
                    .doc = "corners of a closed outline in order, three or more; the last is joined to the first"},
                   &S::points),
      value_key<S>({.key = "up",
                    .type = T::choice,
                    .choices = {"x", "y", "z", "-x", "-y", "-z"},
                    .only_for = {"shape", {"height_map"}},
                    .unset = "against gravity at t = 0; \"y\" without gravity",
                    .doc = "axis of the heights"},
                   &S::up),
      geometry_key(
          {"expression"},
          {.key = "phi", .type = T::formula, .variables = "xyz", .doc = "negative inside; need not be a distance"},
          &S::phi),
  };
}

void check_extension(SceneContext& c, const Place& p, const ShapeSpec& shape, MeshFiles files) {
  std::string ending = shape.file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char ch) { return std::tolower(ch); });
  const std::string path = join_path(p.path, "file");
  const int line = p.node->find("file")->value.line;
  const auto is_any = [&](std::vector<std::string> known) {
    return std::find(known.begin(), known.end(), ending) != known.end();
  };
  if (shape.kind == "level_set" && !is_any({".vdb"})) {
    c.report(path, line,
             fmt::format("{}: a level_set is read from a .vdb file, not '{}'", path, shape.file.filename().string()));
  }
  if (shape.kind == "height_map" && !is_any({".png", ".csv", ".txt", ".asc"}))
    c.report(path, line,
             fmt::format("{}: a height_map is read from .png, .csv, .txt or .asc, not '{}'", path,
                         shape.file.filename().string()));
  const bool flat = c.dimension == 2;
  if (shape.kind != "mesh" || (flat ? is_any({".csv", ".txt", ".obj"}) : is_any({".obj", ".ply", ".stl"}))) return;
  const bool elements = holds_elements(shape.file);
  if (elements && files == MeshFiles::surfaces_and_elements) return;
  c.report(path, line,
           fmt::format("{}: {}; {}{}", path,
                       elements ? "elements are for elastic solids"
                                : "cannot read a mesh from '" + shape.file.filename().string() + "'",
                       flat ? "a mesh in 2D is a closed outline: points a row in .csv or .txt, or lines in .obj"
                            : "a mesh is a closed triangle surface in .obj, .ply or .stl",
                       files == MeshFiles::surfaces ? "" : ", or elements in .msh, .vtu or .mesh"));
}

void check_extent(SceneContext& c, const Place& p, const ShapeSpec& shape) {
  for (int axis = 0; axis < c.dimension; ++axis) {
    if (shape.lower[axis] < shape.upper[axis]) continue;
    c.report(p, fmt::format("the box of {} must have lower < upper; along {} they are {} and {}", section_title(p.path),
                            "xyz"[axis], shape.lower[axis], shape.upper[axis]));
  }
}

// Outlines that cross themselves are found as the shape is made.
void check_polygon(SceneContext& c, const Place& p, const ShapeSpec& shape) {
  const std::string path = join_path(p.path, "points");
  if (c.dimension != 2)
    return c.report(p, join_path(p.path, "shape") + ": a polygon exists in 2D only; give a mesh, or an expression");
  std::vector<Vec3> corners = shape.points;
  if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  const Place place{&p.node->find("points")->value, path};
  if (corners.size() < 3)
    return c.report(place, fmt::format("{} gives {} corner{}; an outline takes 3 or more", path, corners.size(),
                                       corners.size() == 1 ? "" : "s"));
  for (std::size_t n = 1; n < corners.size(); ++n)
    if (corners[n] == corners[n - 1])
      return c.report({&place.node->items[n], path},
                      fmt::format("{}: corners {} and {} are both ({:g}, {:g}); remove one", path, n, n + 1,
                                  corners[n][0], corners[n][1]));
}

}  // namespace

void check_axis(SceneContext& c, const Place& p, const Vec3& axis) {
  const TomlEntry* given = p.node->find("axis");
  const std::string path = join_path(p.path, "axis");
  if (!given && c.dimension == 3)
    c.report(path, p.node->line, p.path + " needs an axis in 3D, for instance axis = [0, 1, 0]");
  if (!given || !c.clean(path)) return;
  const Place place{&given->value, path};
  if (axis.norm() == 0) return c.report(place, path + " must not be zero");
  if (c.dimension == 2 && axis.head<2>().norm() != 0) c.report(place, path + " must be [0, 0, 1] in 2D, or left out");
}

void finish_shape(SceneContext& c, const Place& p, ShapeSpec& shape, MeshFiles files) {
  shape.where = c.where(p.node->line);
  if (!c.clean(p.path) || c.dimension == 0) return;
  if (shape.kind == "box" || shape.kind == "height_map") check_extent(c, p, shape);
  if (c.dimension == 2 && shape.up && shape.up->back() == 'z')
    c.report(p, join_path(p.path, "up") + ": a scene in 2D has no axis z");
  if (shape.kind == "plane" && shape.normal.norm() == 0) c.report(p, join_path(p.path, "normal") + " must not be zero");
  const bool axial_shape = std::find(axial.begin(), axial.end(), shape.kind) != axial.end();
  if (axial_shape && shape.from == shape.to) {
    c.report(
        p, fmt::format("the {} of {} has no axis: from and to are the same point", shape.kind, section_title(p.path)));
  }
  if (shape.kind == "polygon") check_polygon(c, p, shape);
  if (!shape.file.empty()) check_extension(c, p, shape, files);
}

Section<TransformSpec> placement_section() {
  Section<TransformSpec> s;
  s.keys = {inline_key<TransformSpec>({.key = "rotate", .unset = "no rotation", .doc = "about the origin, after scale"},
                                      &TransformSpec::rotate, rotation_section()),
            value_key<TransformSpec>(
                {.key = "translate", .type = T::vector, .unit = "m", .unset = "zero", .doc = "applied last"},
                &TransformSpec::translate)};
  return s;
}

Section<ShapeSpec> shape_section() {
  Section<ShapeSpec> s;
  const auto transform = [](auto& shape) -> auto& {
    return shape.transform;
  };
  s.keys = {value_key<ShapeSpec>({.key = "shape",
                                  .type = T::choice,
                                  .choices = {"box", "sphere", "cylinder", "capsule", "plane", "polygon", "mesh",
                                              "expression", "level_set", "height_map"},
                                  .presence = Presence::required,
                                  .doc = "kind of shape; it decides which further keys there are; polygon: in 2D"},
                                 &ShapeSpec::kind)};
  for (Key<ShapeSpec>& key : geometry_keys()) s.keys.push_back(std::move(key));
  s.keys.push_back(value_key<ShapeSpec>({.key = "invert",
                                         .type = T::boolean,
                                         .doc = "true: the outside of the shape (an inverted sphere is a container)"},
                                        &ShapeSpec::invert));
  Section<TransformSpec> t;
  t.keys = {value_key<TransformSpec>(
      {.key = "scale", .range = positive(), .doc = "factor about the origin, applied first"}, &TransformSpec::scale)};
  for (Key<TransformSpec>& key : placement_section().keys) t.keys.push_back(std::move(key));
  for (Key<ShapeSpec>& key : lift<ShapeSpec>(t, transform)) s.keys.push_back(std::move(key));
  return s;
}

}  // namespace seiche
