#include "scene/materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/options.h"
#include "base/suggest.h"

namespace seiche {
namespace {

using State = MaterialState;

// Handbook: W. M. Haynes (ed.), CRC Handbook of Chemistry and Physics, 97th edition (2016). Wood: Forest Products
// Laboratory, Wood Handbook (2010), at 12 % moisture. Ashby: M. Ashby, Materials Selection in Mechanical Design (2011),
// middles of ranges. "typical": natural products, which differ by a tenth and more.
const NamedMaterial table[] = {
    {"water", State::liquid, 998.2, 1.002e-3, 0.0728, 0, 0, "Handbook"},
    {"seawater", State::liquid, 1024.8, 1.08e-3, 0.0735, 0, 0, "Sharqawy et al. (2010), 35 g/kg"},
    {"ethanol", State::liquid, 789.3, 1.2e-3, 0.0223, 0, 0, "Handbook"},
    {"glycerol", State::liquid, 1261, 1.41, 0.0634, 0, 0, "Segur and Oberstar (1951)"},
    {"mercury", State::liquid, 13546, 1.55e-3, 0.486, 0, 0, "Handbook"},
    {"olive_oil", State::liquid, 911, 0.084, 0.032, 0, 0, "typical"},
    {"honey", State::liquid, 1420, 10, 0.06, 0, 0, "typical"},
    {"milk", State::liquid, 1030, 2e-3, 0.047, 0, 0, "typical"},
    {"blood", State::liquid, 1060, 3.5e-3, 0.056, 0, 0, "typical, 37 C, fast flow"},
    {"air", State::gas, 1.204, 1.825e-5, 0, 0, 0, "Handbook"},
    {"helium", State::gas, 0.1664, 1.96e-5, 0, 0, 0, "Handbook"},
    {"carbon_dioxide", State::gas, 1.839, 1.47e-5, 0, 0, 0, "Handbook"},
    {"balsa", State::solid, 160, 0, 0, 0, 0, "Wood"},
    {"cork", State::solid, 180, 0, 0, 2e7, 0.05, "Ashby"},
    {"pine", State::solid, 450, 0, 0, 0, 0, "Wood"},
    {"oak", State::solid, 680, 0, 0, 0, 0, "Wood"},
    {"ice", State::solid, 917, 0, 0, 9.3e9, 0.33, "Handbook"},
    {"polystyrene_foam", State::solid, 30, 0, 0, 5e6, 0.1, "Ashby"},
    {"polyethylene", State::solid, 950, 0, 0, 0.8e9, 0.42, "Ashby"},
    {"nylon", State::solid, 1130, 0, 0, 2.9e9, 0.38, "Ashby"},
    {"acrylic", State::solid, 1190, 0, 0, 3.0e9, 0.39, "Ashby"},
    {"rubber", State::solid, 930, 0, 0, 2e6, 0.49, "Ashby, natural rubber"},
    {"silicone", State::solid, 1100, 0, 0, 1e6, 0.49, "typical, soft"},
    {"gelatin", State::solid, 1010, 0, 0, 5e3, 0.49, "typical, dessert"},
    {"concrete", State::solid, 2400, 0, 0, 30e9, 0.2, "Ashby"},
    {"granite", State::solid, 2650, 0, 0, 50e9, 0.25, "Ashby"},
    {"glass", State::solid, 2500, 0, 0, 70e9, 0.22, "Ashby, soda-lime"},
    {"aluminium", State::solid, 2700, 0, 0, 70e9, 0.35, "Handbook"},
    {"steel", State::solid, 7850, 0, 0, 206e9, 0.29, "Ashby, low carbon"},
    {"copper", State::solid, 8960, 0, 0, 130e9, 0.34, "Handbook"},
    {"lead", State::solid, 11340, 0, 0, 16e9, 0.44, "Handbook"},
};

void give(TomlNode& table_node, const std::string& key, double value, int line) {
  if (value == 0 || table_node.find(key)) return;
  TomlNode node;
  node.kind = TomlNode::Kind::number;
  node.line = line;
  node.number = value;
  table_node.entries.push_back({key, line, node});
}

void remove(TomlNode& node, const std::string& key) {
  std::erase_if(node.entries, [&](const TomlEntry& entry) { return entry.key == key; });
}

bool names_kind(const TomlNode& solid, const char* kind) {
  const TomlEntry* entry = solid.find("kind");
  return entry && entry->value.text == kind;
}

class Materials {
 public:
  explicit Materials(SceneContext& context) : context_(context) {}

  // The material of this state that a text names; null and reported if there is none.
  const NamedMaterial* find(const TomlNode& node, const std::string& path, State state) const {
    for (const NamedMaterial& material : table)
      if (material.state == state && node.text == material.name) return &material;
    const std::vector<std::string> names = material_names(state);
    const auto near = suggest(node.text, names);
    context_.report(path, node.line,
                    near ? fmt::format("{}: there is no '{}'; did you mean '{}'?", path, node.text, *near)
                         : fmt::format("{}: there is no '{}'; known are {}", path, node.text, quoted_list(names)));
    return nullptr;
  }

  void fill_fluid(TomlNode& root, const std::string& key, State state) const {
    TomlEntry* fluid = root.find(key);
    if (!fluid || fluid->value.kind != TomlNode::Kind::table) return;
    TomlNode& node = fluid->value;
    const TomlEntry* named = node.find("material");
    if (!named || named->value.kind != TomlNode::Kind::text) return;
    const TomlNode name = named->value;
    remove(node, "material");
    const NamedMaterial* material = find(name, key + ".material", state);
    if (!material) return;
    give(node, "density", material->density, name.line);
    if (!node.find("rheology")) give(node, "viscosity", material->viscosity, name.line);
    if (state == State::liquid) give(node, "surface_tension", material->surface_tension, name.line);
  }

  void fill_solid(TomlNode& solid, const std::string& path) const {
    TomlEntry* entry = solid.find("material");
    if (!entry) return;
    const bool is_table = entry->value.kind == TomlNode::Kind::table;
    if (is_table && !entry->value.find("name")) return;
    const TomlNode name = is_table ? entry->value.find("name")->value : entry->value;
    if (name.kind != TomlNode::Kind::text) return;  // as the reader of the key reports
    if (is_table)
      remove(entry->value, "name");
    else
      remove(solid, "material");
    const NamedMaterial* material = find(name, path + (is_table ? ".material.name" : ".material"), State::solid);
    if (!material) return;
    if (!solid.find("mass")) give(solid, "density", material->density, name.line);
    if (names_kind(solid, "elastic")) fill_elastic(solid, path, name, *material);
  }

 private:
  void fill_elastic(TomlNode& solid, const std::string& path, const TomlNode& name,
                    const NamedMaterial& material) const {
    TomlEntry* entry = solid.find("material");
    if (material.youngs_modulus == 0 && !(entry && entry->value.find("youngs_modulus")))
      context_.report(path + ".material", name.line,
                      fmt::format("{}.material: of '{}' only the density is known; give youngs_modulus and "
                                  "poisson_ratio too",
                                  path, material.name));
    if (!entry) {
      solid.entries.push_back({"material", name.line, {}});
      entry = &solid.entries.back();
      entry->value.line = name.line;
    }
    give(entry->value, "youngs_modulus", material.youngs_modulus, name.line);
    give(entry->value, "poisson_ratio", material.poisson_ratio, name.line);
  }

  SceneContext& context_;
};

}  // namespace

const std::vector<NamedMaterial>& named_materials() {
  static const std::vector<NamedMaterial> all(std::begin(table), std::end(table));
  return all;
}

std::vector<std::string> material_names(MaterialState state) {
  std::vector<std::string> names;
  for (const NamedMaterial& material : table)
    if (material.state == state) names.emplace_back(material.name);
  return names;
}

void fill_in_materials(SceneContext& context, TomlNode& root) {
  const Materials materials(context);
  materials.fill_fluid(root, "liquid", MaterialState::liquid);
  materials.fill_fluid(root, "gas", MaterialState::gas);
  TomlEntry* solids = root.find("solid");
  if (!solids || solids->value.kind != TomlNode::Kind::array) return;
  for (std::size_t k = 0; k < solids->value.items.size(); ++k)
    materials.fill_solid(solids->value.items[k], fmt::format("solid.{}", k));
}

}  // namespace seiche
