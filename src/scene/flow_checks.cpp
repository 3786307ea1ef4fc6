// Features that a scene with prescribed flow must not have.
#include <fmt/format.h>

#include <algorithm>

#include "base/expression.h"
#include "base/scene.h"
#include "scene/checks.h"

namespace seiche {
namespace {

bool is_zero(const Expression& value) {
  return value.is_constant() && value(Vec3::Zero(), 0) == 0;
}

bool is_zero(const VectorFormula& formula) {
  return std::all_of(formula.begin(), formula.end(), [](const Formula& text) { return is_zero(Expression(text)); });
}

// Keys of features that a prescribed flow excludes.
std::vector<std::string> beside_prescribed_flow(const Scene& scene) {
  const LiquidSpec& liquid = scene.liquid;
  const auto moves = [](const auto& list) {
    return std::any_of(list.begin(), list.end(), [](const LiquidSourceSpec& s) { return !is_zero(s.velocity); });
  };
  const auto has_own = [](const LiquidRegionSpec& region) { return region.velocity.has_value(); };
  const std::vector<std::pair<const char*, bool>> all{
      {"liquid.velocity", !is_zero(liquid.velocity)},
      {"liquid.region.velocity", std::any_of(liquid.regions.begin(), liquid.regions.end(), has_own)},
      {"liquid.source.velocity", moves(liquid.sources)},
      {"liquid.viscosity", !is_zero(Expression(liquid.viscosity))},
      {"liquid.rheology", !liquid.rheology.model.empty()},
      {"liquid.surface_tension", liquid.surface_tension > 0},
      {"liquid.separates", liquid.separates},
      {"liquid.sponge", !liquid.sponges.empty()},
      {"[gas]", scene.gas.present},
      {"[[solid]]", !scene.solids.empty()},
      {"[[force]]", !scene.forces.empty()},
  };
  std::vector<std::string> names;
  for (const auto& [name, given] : all)
    if (given) names.emplace_back(name);
  return names;
}

}  // namespace

void check_prescribed_flow(SceneContext& context, const TomlNode& root, const Scene& scene) {
  if (!scene.liquid.prescribed_velocity) return;
  const std::string path = "liquid.prescribed_velocity";
  const std::vector<std::string> names = beside_prescribed_flow(scene);
  if (names.empty()) return;
  context.report(path, line_of(root, path),
                 fmt::format("{}: the flow is prescribed and not solved, so {} would have no effect; remove {}, or "
                             "prescribed_velocity",
                             path, fmt::join(names, ", "), names.size() > 1 ? "these" : "it"));
}

}  // namespace seiche
