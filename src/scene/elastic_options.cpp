// Keys of [[solid]] for elastic solids.
#include <fmt/format.h>

#include "base/solid_spec.h"
#include "scene/options.h"
#include "solid/material/material.h"
#include "solid/mesh/file.h"

namespace seiche {
namespace {

using T = OptionType;
using S = ElasticSpec;

std::vector<std::string> elastic_models() {
  std::vector<std::string> names;
  for (const auto& material : elastic_materials<3>()) names.emplace_back(material.name);
  return names;
}

// At 1/2 the material is incompressible: lambda = E nu / ((1 + nu)(1 - 2 nu)) is infinite.
Key<S> poisson_key() {
  Key<S> key = value_key<S>({.key = "poisson_ratio",
                             .range = {0, 0.5, Bound::included, Bound::excluded},
                             .presence = Presence::required,
                             .doc = "Poisson's ratio; 0.5 would keep volume exactly, with an infinite bulk modulus"},
                            &S::poisson_ratio);
  const auto read = key.read;
  key.read = [read](SceneContext& c, const Place& p, S& elastic) {
    const bool is_number = p.node->kind == TomlNode::Kind::number || p.node->kind == TomlNode::Kind::integer;
    if (!is_number || !(p.node->number >= 0.5)) return read(c, p, elastic);
    c.report(p, fmt::format("{} must be below 0.5; it is {}. At 0.5 a material keeps its volume exactly and its bulk "
                            "modulus E / (3 (1 - 2 nu)) is infinite; rubber is 0.49 to 0.4995",
                            p.path, p.node->number));
  };
  return key;
}

Section<S> material_section() {
  Section<S> s;
  const Range not_negative = between(0, number_limit);
  s.keys = {
      material_key<S>(MaterialState::solid),
      value_key<S>({.key = "model", .type = T::choice, .choices = elastic_models(), .doc = "energy of deformation"},
                   &S::model),
      value_key<S>({.key = "youngs_modulus",
                    .unit = "Pa",
                    .range = positive(),
                    .presence = Presence::required,
                    .doc = "Young's modulus"},
                   &S::youngs_modulus),
      poisson_key(),
      value_key<S>({.key = "damping",
                    .unit = "s",
                    .range = not_negative,
                    .doc = "Rayleigh damping in proportion to stiffness: faster deformation is damped more"},
                   &S::damping),
      value_key<S>({.key = "mass_damping",
                    .unit = "1/s",
                    .range = not_negative,
                    .doc = "Rayleigh damping in proportion to mass: slows all motion, also that of the whole solid"},
                   &S::mass_damping),
  };
  return s;
}

Section<PinSpec> pin_section() {
  Section<PinSpec> s;
  for (Key<PinSpec>& key : lift<PinSpec>(shape_section(), &PinSpec::shape)) s.keys.push_back(std::move(key));
  s.keys.push_back(inline_key<PinSpec>(
      {.key = "motion", .unset = "held at rest", .doc = "how the pinned part moves: translate and/or rotate"},
      &PinSpec::motion, motion_section()));
  s.finish = [](SceneContext& c, const Place& p, PinSpec& pin) { finish_shape(c, p, pin.shape); };
  return s;
}

Section<TractionSpec> traction_section() {
  Section<TractionSpec> s;
  for (Key<TractionSpec>& key : lift<TractionSpec>(shape_section(), &TractionSpec::shape))
    s.keys.push_back(std::move(key));
  s.keys.push_back(value_key<TractionSpec>({.key = "stress",
                                            .type = T::formula_vector,
                                            .unit = "Pa",
                                            .variables = "xyzt",
                                            .presence = Presence::required,
                                            .doc = "force per area at rest, at points at rest; it keeps its direction"},
                                           &TractionSpec::stress));
  s.finish = [](SceneContext& c, const Place& p, TractionSpec& traction) { finish_shape(c, p, traction.shape); };
  return s;
}

// Reads one table or a list of tables.
template <class Entry>
void read_tables(SceneContext& c, const Place& p, const Option& option, const Section<Entry>& section,
                 const std::vector<Option>& options, std::vector<Entry>& entries) {
  if (p.node->kind != TomlNode::Kind::array) {
    entries.resize(1);
    if (check_is_table(c, p, option)) read_section(c, p, section, options, entries[0]);
    return;
  }
  if (!check_is_table_list(c, p, option)) return;
  entries.resize(p.node->items.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Place one{&p.node->items[i], join_path(p.path, std::to_string(i))};
    read_section(c, one, section, options, entries[i]);
  }
}

// Writes nothing, one table, or a list of tables on one line.
template <class Entry>
std::string tables_text(const std::vector<Entry>& entries, int dimension, const std::string& path,
                        const Section<Entry>& section) {
  std::string text;
  for (const Entry& entry : entries)
    text += (text.empty() ? "" : ", ") + inline_table(write_section(section, entry, dimension, path));
  return entries.size() > 1 ? "[" + text + "]" : text;
}

template <class Entry>
Key<S> tables_key(const Option& option, const Section<Entry>& section, std::vector<Entry> S::*member) {
  const std::vector<Option> options = own_options(section);
  Key<S> key{option, {}, {}, [section] { return all_options(section); }};
  key.read = [=](SceneContext& c, const Place& p, S& elastic) {
    read_tables(c, p, option, section, options, elastic.*member);
  };
  key.write = [=](const S& elastic, int dimension, const std::string& path, SceneLines& lines) {
    const std::string here = join_path(path, option.key);
    const std::string text = tables_text(elastic.*member, dimension, here, section);
    if (!text.empty()) lines.push_back({here, option.key, text});
  };
  return key;
}

Key<S> pinned_key() {
  return tables_key<PinSpec>(
      {.key = "pinned",
       .type = T::table,
       .only_for = {"kind", {"elastic"}},
       .unset = "free to move",
       .doc = "a shape, or a list of shapes: nodes that lie in it at rest are held, or move as its "
              "motion says",
       .most = most_entries},
      pin_section(), &S::pinned);
}

Key<S> traction_key() {
  return tables_key<TractionSpec>(
      {.key = "traction",
       .type = T::table,
       .only_for = {"kind", {"elastic"}},
       .unset = "none",
       .doc = "a shape with a stress, or a list of them: sides of elements that lie in it at "
              "rest are pushed or pulled",
       .most = most_entries},
      traction_section(), &S::tractions);
}

Key<S> element_size_key() {
  Key<S> key = value_key<S>({.key = "element_size",
                             .unit = "m",
                             .range = positive(),
                             .only_for = {"kind", {"elastic"}},
                             .unset = "that of the file's elements; other shapes must give it",
                             .doc = "edge of an element; a thinner plate gets one element across"},
                            &S::element_size);
  const auto write = key.write;
  key.write = [write](const S& elastic, int dimension, const std::string& path, SceneLines& lines) {
    if (elastic.element_size > 0) write(elastic, dimension, path, lines);
  };
  return key;
}

// element_size is required, except if a file gives the elements.
void check_element_size(SceneContext& c, const Place& p, const SolidSpec& solid) {
  const bool from_file = solid.shape.kind == "mesh" && holds_elements(solid.shape.file);
  const std::string path = join_path(p.path, "element_size");
  const TomlEntry* given = p.node->find("element_size");
  if (!given && !from_file) {
    c.report(path, p.node->line,
             fmt::format("{} needs 'element_size' (m) with kind = \"elastic\": the edge of an element, half of the "
                         "thinnest part or less",
                         section_title(p.path)));
  }
  if (given && from_file) {
    c.report(path, given->line,
             fmt::format("{} has no effect, because the elements come from '{}'; remove it", path,
                         solid.shape.file.filename().string()));
  }
}

}  // namespace

Section<S> elastic_section() {
  const Condition elastic{"kind", {"elastic"}};
  const auto itself = [](auto& s) -> auto& {
    return s;
  };
  Section<S> s;
  s.keys = {
      inline_key<S>(
          {.key = "material",
           .only_for = elastic,
           .presence = Presence::required,
           .doc = "its elastic law: youngs_modulus and poisson_ratio, or the name of a material, as \"rubber\""},
          itself, material_section()),
      element_size_key(),
      value_key<S>({.key = "element_order",
                    .type = T::integer,
                    .range = between(1, 2),
                    .only_for = elastic,
                    .unset = "2",
                    .doc = "1: linear elements, for thick bodies that barely bend; 2: quadratic ones"},
                   &S::element_order),
      pinned_key(),
      value_key<S>({.key = "body_force",
                    .type = T::formula_vector,
                    .unit = "N/m^3",
                    .variables = "xyzt",
                    .only_for = elastic,
                    .unset = "none",
                    .doc = "force on the solid beside gravity, at points at rest, per volume at rest"},
                   &S::body_force),
      traction_key(),
  };
  return s;
}

void finish_elastic(SceneContext& c, const Place& p, const SolidSpec& solid) {
  check_mass(c, p, solid);
  check_bounded(c, p, solid.shape, "an elastic solid");
  check_element_size(c, p, solid);
}

}  // namespace seiche
