// Keys of [[solid]].
#include <fmt/format.h>

#include "base/numbered_files.h"
#include "base/solid_spec.h"
#include "coupling/solids/solid_kinds.h"
#include "scene/copies.h"
#include "scene/options.h"
#include "scene/waves.h"

namespace seiche {
namespace {

using T = OptionType;

Section<MotionSpec> motion_rotation_section() {
  Section<MotionSpec> s;
  s.keys = {
      value_key<MotionSpec>({.key = "axis", .type = T::axis, .doc = "axis of rotation; 3D scenes must give it"},
                            &MotionSpec::axis),
      value_key<MotionSpec>(
          {.key = "center", .type = T::vector, .unit = "m", .unset = "the origin", .doc = "a point of the axis"},
          &MotionSpec::center),
      value_key<MotionSpec>({.key = "degrees",
                             .type = T::formula,
                             .unit = "degrees",
                             .variables = "t",
                             .presence = Presence::required,
                             .doc = "angle as a function of t"},
                            &MotionSpec::degrees),
  };
  s.finish = [](SceneContext& c, const Place& p, MotionSpec& m) { check_axis(c, p, m.axis); };
  return s;
}

Key<SolidSpec> kind_key() {
  std::string doc;
  std::vector<std::pair<std::string, SolidKind>> choices;
  for (const SolidKindRow& row : solid_kinds()) {
    doc += (doc.empty() ? "" : "; ") + std::string(row.kind.name) + ": " + row.doc;
    choices.emplace_back(row.kind.name, row.kind);
  }
  return choice_key<SolidSpec, SolidKind SolidSpec::*, SolidKind>({.key = "kind", .doc = doc}, &SolidSpec::kind,
                                                                  choices);
}

Section<SequenceSpec> sequence_section() {
  constexpr int most_meshes = 100000;
  Section<SequenceSpec> s;
  s.keys = {
      value_key<SequenceSpec>({.key = "meshes",
                               .type = T::integer,
                               .range = between(2, most_meshes),
                               .presence = Presence::required,
                               .doc = "number of files; their names count up from that of file, as in flag.0000.ply, "
                                      "flag.0001.ply, ..."},
                              &SequenceSpec::meshes),
      value_key<SequenceSpec>({.key = "rate",
                               .unit = "1/s",
                               .range = positive(),
                               .presence = Presence::required,
                               .doc = "meshes a second; in between the points move as cubics in time, with steady "
                                      "velocities"},
                              &SequenceSpec::rate),
      value_key<SequenceSpec>({.key = "start", .unit = "s", .doc = "time of the first mesh"}, &SequenceSpec::start),
      value_key<SequenceSpec>({.key = "loop",
                               .type = T::boolean,
                               .doc = "true: the first mesh follows the last, also before start; false: the solid "
                                      "rests before the first mesh and after the last"},
                              &SequenceSpec::loop),
  };
  return s;
}

// Reports files of a sequence that cannot be read, the first alone.
void check_files(SceneContext& c, const Place& p, const SolidSpec& solid) {
  const std::string path = join_path(p.path, "file");
  const int line = p.node->find("file")->value.line;
  const std::vector<std::filesystem::path> files = numbered_files(solid.shape.file, solid.sequence.meshes);
  if (files.empty())
    return c.report(path, line,
                    fmt::format("{}: the name of the first mesh of a sequence needs a number that counts up, as in "
                                "flag.0000.ply; '{}' has none of up to nine digits",
                                path, solid.shape.file.filename().string()));
  for (const std::filesystem::path& file : files) {
    std::filesystem::path found;
    const std::string fault = fault_of_path(c, file, found);
    if (!fault.empty())
      return c.report(path, line, fmt::format("{}: {}; sequence.meshes counts {} files", path, fault, files.size()));
  }
}

void finish_deforming(SceneContext& c, const Place& p, const SolidSpec& solid) {
  if (solid.shape.kind != "mesh")
    return c.report(
        p, fmt::format("{}: a deforming solid is a sequence of meshes; give shape = \"mesh\"", section_title(p.path)));
  if (solid.shape.invert)
    return c.report(p, join_path(p.path, "invert") + ": a deforming solid cannot be the outside of its meshes");
  check_files(c, p, solid);
}

// A number that belongs to one kind only.
Key<SolidSpec> own_key(const SolidKind& kind, Option option) {
  option.only_for = {"kind", {kind.name}};
  Key<SolidSpec> key{option, {}, {}};
  key.read = [option](SceneContext& c, const Place& p, SolidSpec& s) {
    double value = 0;
    read_value(c, p, option, value);
    s.numbers[option.key] = value;
  };
  key.write = [option](const SolidSpec& s, int dimension, const std::string& path, SceneLines& lines) {
    const auto found = s.numbers.find(option.key);
    if (found == s.numbers.end()) return;
    lines.push_back({join_path(path, option.key), option.key, to_toml(found->second, option, dimension)});
  };
  return key;
}

}  // namespace

Section<MotionSpec> motion_section() {
  Section<MotionSpec> s;
  const auto itself = [](auto& m) -> auto& {
    return m;
  };
  s.keys = {
      value_key<MotionSpec>({.key = "translate",
                             .type = T::formula_vector,
                             .unit = "m",
                             .variables = "t",
                             .unset = "zero",
                             .doc = "displacement from the rest pose as a function of t"},
                            &MotionSpec::translate),
      inline_key<MotionSpec>({.key = "rotate", .unset = "no rotation", .doc = "rotation, applied before translate"},
                             itself, motion_rotation_section()),
      optional_table_key<MotionSpec>(
          {.key = "waves", .unset = "none", .doc = "motion of a wave maker, in place of both"}, &MotionSpec::waves,
          waves_section()),
  };
  s.finish = [](SceneContext& c, const Place& p, MotionSpec&) {
    if (p.node->find("waves") && (p.node->find("translate") || p.node->find("rotate")))
      c.report(p, p.path + ": waves make the motion; leave translate and rotate out");
  };
  return s;
}

namespace {

std::vector<Key<SolidSpec>> prescribed_keys() {
  return {inline_key<SolidSpec>({.key = "motion",
                                 .only_for = {"kind", {"kinematic"}},
                                 .presence = Presence::required,
                                 .doc = "how it moves: translate and/or rotate as functions of t"},
                                &SolidSpec::motion, motion_section()),
          inline_key<SolidSpec>({.key = "sequence",
                                 .only_for = {"kind", {"deforming"}},
                                 .presence = Presence::required,
                                 .doc = "meshes that it takes on one after the other, of which file is the first"},
                                &SolidSpec::sequence, sequence_section())};
}

}  // namespace

Section<SolidSpec> solid_section() {
  Section<SolidSpec> s;
  s.keys = {
      value_key<SolidSpec>({.key = "name", .type = T::text, .unset = "`solid1`, `solid2`, ...", .doc = "unique name"},
                           &SolidSpec::name),
      kind_key()};
  for (Key<SolidSpec>& key : lift<SolidSpec>(shape_section(), &SolidSpec::shape)) s.keys.push_back(std::move(key));
  s.keys.push_back(choice_key<SolidSpec, Slip SolidSpec::*, Slip>(
      {.key = "slip", .doc = "whether liquid slips along the surface or sticks to it"}, &SolidSpec::slip,
      {{"free_slip", Slip::free_slip}, {"no_slip", Slip::no_slip}}));
  for (Key<SolidSpec>& key : prescribed_keys()) s.keys.push_back(std::move(key));
  for (Key<SolidSpec>& key : lift<SolidSpec>(rigid_section(), &SolidSpec::rigid)) s.keys.push_back(std::move(key));
  s.keys.push_back(value_key<SolidSpec>({.key = "friction",
                                         .range = between(0, number_limit),
                                         .unset = "that of the other solid; 0 if both leave it out",
                                         .doc = "Coulomb's coefficient in contacts with other solids"},
                                        &SolidSpec::friction));
  Option angle = contact_angle_option("at this solid");
  angle.unset = "that of [liquid]";
  s.keys.push_back(value_key<SolidSpec>(angle, &SolidSpec::contact_angle));
  for (Key<SolidSpec>& key : lift<SolidSpec>(elastic_section(), &SolidSpec::elastic)) s.keys.push_back(std::move(key));
  for (Key<SolidSpec>& key : copy_keys()) s.keys.push_back(std::move(key));
  for (const SolidKindRow& row : solid_kinds())
    for (const Option& option : row.numbers) s.keys.push_back(own_key(row.kind, option));
  s.finish = [](SceneContext& c, const Place& p, SolidSpec& solid) {
    const bool has_elements = solid.kind.has_elements;
    finish_shape(c, p, solid.shape, has_elements ? MeshFiles::surfaces_and_elements : MeshFiles::surfaces);
    if (!c.clean(p.path)) return;
    if (solid.kind.follows_meshes) return finish_deforming(c, p, solid);
    if (!solid.kind.is_free()) return;
    has_elements ? finish_elastic(c, p, solid) : finish_rigid(c, p, solid);
  };
  return s;
}

}  // namespace seiche
