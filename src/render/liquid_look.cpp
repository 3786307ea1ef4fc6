#include "render/liquid_look.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "base/fluid_spec.h"
#include "base/suggest.h"
#include "scene/materials.h"

namespace seiche::render {
namespace {

struct NamedLook {
  const char* name;
  LiquidLook look;
};

const Vec3f none = Vec3f::Zero();

// Indices of refraction at 589 nm: CRC Handbook of Chemistry and Physics, 97th edition (2016); honey, milk and blood:
// typical. Colours are chosen by eye.
const NamedLook looks[] = {
    {"water", {}},
    {"seawater", {{9.0f, 2.0f, 2.2f}, {0.010f, 0.125f, 0.150f}, 1.34f, none, none, from_srgb(0.16f, 0.50f, 0.62f)}},
    {"ethanol", {{1.0f, 0.8f, 0.8f}, {0.10f, 0.11f, 0.12f}, 1.36f, none, none, from_srgb(0.62f, 0.72f, 0.80f)}},
    {"glycerol", {{0.9f, 0.9f, 1.4f}, {0.13f, 0.13f, 0.11f}, 1.47f, none, none, from_srgb(0.70f, 0.74f, 0.72f)}},
    {"mercury", {none, none, 1.5f, none, {0.78f, 0.78f, 0.76f}, from_srgb(0.62f, 0.63f, 0.65f)}},
    {"olive_oil", {{1.8f, 3.2f, 22.0f}, {0.34f, 0.24f, 0.015f}, 1.47f, none, none, from_srgb(0.66f, 0.62f, 0.14f)}},
    {"honey", {{1.5f, 6.0f, 40.0f}, {0.42f, 0.14f, 0.006f}, 1.49f, none, none, from_srgb(0.84f, 0.54f, 0.07f)}},
    {"milk", {none, none, 1.35f, {0.90f, 0.88f, 0.82f}, none, from_srgb(0.91f, 0.89f, 0.83f)}},
    {"blood", {none, none, 1.36f, {0.24f, 0.007f, 0.009f}, none, from_srgb(0.55f, 0.03f, 0.05f)}},
};

// Viscosity at the start and at the origin, Pa s; 0 for liquids with a rheology.
double viscosity_of(const LiquidSpec& liquid) {
  return liquid.rheology.model.empty() ? Expression(liquid.viscosity)(Vec3::Zero(), 0) : 0;
}

bool is_near(double value, double wanted, double share) {
  return std::abs(value - wanted) <= share * wanted;
}

}  // namespace

const LiquidLook& liquid_look(const std::string& name) {
  std::vector<std::string> names;
  for (const NamedLook& row : looks) {
    if (name == row.name) return row.look;
    names.emplace_back(row.name);
  }
  const auto near = suggest(name, names);
  throw Error(ExitCode::bad_input, fmt::format("--material: there is no liquid '{}'{}; liquids are {}", name,
                                               near ? "; did you mean '" + *near + "'?" : "", fmt::join(names, ", ")));
}

std::string material_of(const LiquidSpec& liquid) {
  const double viscosity = viscosity_of(liquid);
  for (const NamedMaterial& material : named_materials()) {
    if (material.state == MaterialState::liquid && is_near(liquid.density, material.density, 0.002) &&
        is_near(viscosity, material.viscosity, 0.05))
      return material.name;
  }
  if (liquid.density > 5000) return "mercury";
  if (viscosity >= 1) return "honey";
  return viscosity >= 0.02 && liquid.density < 960 ? "olive_oil" : "water";
}

}  // namespace seiche::render
