// Keys of what a scene is built from: other files, named numbers, signals.
#include <fmt/format.h>

#include "base/scene.h"
#include "scene/formula.h"
#include "scene/options.h"

namespace seiche {
namespace {

using T = OptionType;

// merge_includes() reads it first, and takes it out of the file.
Key<Scene> include_key() {
  const Option option{.key = "include",
                      .type = T::text,
                      .unset = "none",
                      .doc = "a scene, or a list of scenes, below this one; see parameters.md"};
  return {option,
          [](SceneContext& c, const Place& p, Scene&) { c.report(p, "include belongs into the file of a scene"); },
          [](const Scene&, int, const std::string&, SceneLines&) {}};
}

// read_parameters() reads it first; the written scene has the numbers in their places.
Key<Scene> parameters_key() {
  const Option option{.key = "parameters",
                      .type = T::table,
                      .unset = "none",
                      .doc = "named numbers for any number or formula of the scene; see parameters.md"};
  return {option, [](SceneContext&, const Place&, Scene&) {},
          [](const Scene&, int, const std::string&, SceneLines&) {}};
}

// read_signals() reads it first.
Key<Scene> signals_key() {
  const Option option{.key = "signals",
                      .type = T::table,
                      .unset = "none",
                      .doc =
                          "numbers in formulas of t that a Python program may change between steps, with their "
                          "values at the start; see python.md"};
  return {option, [](SceneContext&, const Place&, Scene&) {},
          [](const Scene& scene, int, const std::string& path, SceneLines& lines) {
            if (scene.signals.empty()) return;
            const std::string here = join_path(path, "signals");
            lines.push_back({here, "", section_title(here)});
            for (const auto& [name, value] : scene.signals)
              lines.push_back({join_path(here, name), name, number_text(value)});
          }};
}

std::string list_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_text(number);
  return "[" + text + "]";
}

// read_curves() reads it first.
Key<Scene> curves_key() {
  const Option option{.key = "curves",
                      .type = T::table,
                      .unset = "none",
                      .doc = "functions of time for formulas, by points or from CSV files; see parameters.md"};
  return {
      option, [](SceneContext&, const Place&, Scene&) {},
      [](const Scene& scene, int, const std::string& path, SceneLines& lines) {
        if (scene.curves.empty()) return;
        const std::string here = join_path(path, "curves");
        lines.push_back({here, "", section_title(here)});
        for (const auto& [name, curve] : scene.curves)
          lines.push_back({join_path(here, name), name,
                           fmt::format("{{ times = {}, values = {}, interpolate = \"{}\" }}", list_of(curve.times),
                                       list_of(curve.values), curve.form == CurveForm::linear ? "linear" : "smooth")});
      }};
}

}  // namespace

std::vector<Key<Scene>> naming_keys() {
  return {include_key(), parameters_key(), signals_key(), curves_key()};
}

}  // namespace seiche
