// Features that a scene with prescribed flow must not have.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/expression.h"
#include "base/options.h"
#include "base/scene.h"
#include "base/suggest.h"
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
  const auto has_rate = [](const auto& list) {
    return std::any_of(list.begin(), list.end(), [](const LiquidSourceSpec& s) { return s.rate.has_value(); });
  };
  const auto has_own = [](const LiquidRegionSpec& region) { return region.velocity.has_value(); };
  const std::vector<std::pair<const char*, bool>> all{
      {"liquid.velocity", !is_zero(liquid.velocity)},
      {"liquid.region.velocity", std::any_of(liquid.regions.begin(), liquid.regions.end(), has_own)},
      {"liquid.source.velocity", moves(liquid.sources)},
      {"liquid.source.rate", has_rate(liquid.sources)},
      {"liquid.drain.rate", has_rate(liquid.drains)},
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

// Time at which a rate is not finite or negative, looked at evenly over the run; none.
std::optional<double> bad_time(const LiquidSourceSpec& source, double end) {
  constexpr int samples = 500;
  const Expression rate(*source.rate);
  const double last = std::min(source.until, end);
  for (int n = 0; n <= samples && source.from <= last; ++n) {
    const double t = source.from + (last - source.from) * n / samples, value = rate(Vec3::Zero(), t);
    if (!(value >= 0) || !std::isfinite(value)) return t;
  }
  return std::nullopt;
}

}  // namespace

void check_attached(SceneContext& context, const TomlNode& root, const Scene& scene) {
  std::vector<std::string> names;
  for (const SolidSpec& solid : scene.solids)
    if (!solid.kind.deforms()) names.push_back(solid.name);
  const auto check = [&](const std::vector<LiquidSourceSpec>& list, const char* name) {
    for (std::size_t n = 0; n < list.size(); ++n) {
      const std::string wanted = list[n].attached_to.value_or("");
      if (!list[n].attached_to || std::find(names.begin(), names.end(), wanted) != names.end()) continue;
      const auto named = std::ranges::find(scene.solids, wanted, &SolidSpec::name);
      const auto near = suggest(wanted, names);
      const std::string path = fmt::format("liquid.{}.{}.attached_to", name, n);
      context.report(path, line_of(root, path),
                     fmt::format("{}: {}; {}", path,
                                 named != scene.solids.end() ? "\"" + wanted + "\" is a solid that deforms"
                                                             : "no solid is named \"" + wanted + "\"",
                                 near            ? "did you mean \"" + *near + "\"?"
                                 : names.empty() ? "the scene has no other"
                                                 : "there is " + quoted_list(names)));
    }
  };
  check(scene.liquid.sources, "source");
  check(scene.liquid.drains, "drain");
}

void check_rates(SceneContext& context, const TomlNode& root, const Scene& scene) {
  const auto check = [&](const std::vector<LiquidSourceSpec>& list, const char* name, const char* opposite) {
    for (std::size_t n = 0; n < list.size(); ++n) {
      if (list[n].rate && !is_zero(list[n].velocity)) {
        const std::string given = fmt::format("liquid.{}.{}.velocity", name, n);
        context.report(given, line_of(root, given),
                       given +
                           ": a source with a rate takes the velocity of the liquid around it; leave velocity or "
                           "rate out");
      }
      const auto t = list[n].rate ? bad_time(list[n], scene.time.end) : std::nullopt;
      if (!t) continue;
      const std::string path = fmt::format("liquid.{}.{}.rate", name, n);
      context.report(
          path, line_of(root, path),
          fmt::format("{} = \"{}\" is {:g} at t = {:g} s; it must be finite and at least 0: the opposite is a "
                      "[[liquid.{}]]",
                      path, *list[n].rate, Expression(*list[n].rate)(Vec3::Zero(), *t), *t, opposite));
    }
  };
  check(scene.liquid.sources, "source", "drain");
  check(scene.liquid.drains, "drain", "source");
}

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
