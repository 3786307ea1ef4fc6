#pragma once
// Materials by name: `material = "water"` stands for the numbers of a table.
#include <string>
#include <vector>

#include "scene/context.h"
#include "scene/toml.h"

namespace seiche {

enum class MaterialState { liquid, gas, solid };

// Properties at 20 C and 101 kPa; 0: none is known.
struct NamedMaterial {
  const char* name;
  MaterialState state;
  double density;          // kg/m^3
  double viscosity;        // Pa s
  double surface_tension;  // N/m, in air
  double youngs_modulus;   // Pa
  double poisson_ratio;
  const char* source;
};

const std::vector<NamedMaterial>& named_materials();

// Names of a state, in the table's order.
std::vector<std::string> material_names(MaterialState state);

// Gives [liquid], [gas] and each [[solid]] that names a material the keys of it which they leave out, and removes the
// name. A [[solid]] names it as `material = "oak"`, or as `material = { name = "rubber", damping = 0.01 }`. Reports
// names that are not known.
void fill_in_materials(SceneContext& context, TomlNode& root);

}  // namespace seiche
