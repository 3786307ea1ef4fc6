#include "scene/docs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "scene/options.h"

namespace seiche {
namespace {

const char* const introduction = R"doc(# Scene reference

Every key of a scene file, made from the table the reader uses. Units are SI. Vectors have as many components as the
scene has dimensions. Expressions are texts in quotes in x, y, z (m) and t (s), such as `"0.1*sin(2*pi*t)"`, where a
column says which of them they may use; [expressions.md](expressions.md) lists the language. Any number may be
a text with named [parameters](parameters.md) or a unit, such as `"2 cm"`. Whole numbers and
decimals are alike unless a key asks for a whole number; NaN, infinity and magnitudes above 1e15 are refused everywhere.
`seiche run SCENE --set key.path=value` sets any of them; entries of arrays are counted from 0 (`solid.0.radius`). Keys
that are not listed are errors.
)doc";

std::string parent(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string title(const std::string& table) {
  if (table.empty()) return "Top level";
  if (table.size() < 2 || table.substr(table.size() - 2) != "[]") return "`[" + table + "]`";
  return "`[[" + table.substr(0, table.size() - 2) + "]]`";
}

std::string type_text(const Option& option) {
  if (!option.choices.empty()) {
    return (option.type == OptionType::choice_list ? "any of " : "") + quoted_list(option.choices);
  }
  const std::string variables =
      option.variables.empty() ? "" : " in " + fmt::format("{}", fmt::join(option.variables, ", "));
  return type_name(option.type) + variables;
}

std::string default_text(const Option& option) {
  if (option.presence == Presence::required) return "required";
  if (!option.unset.empty()) return option.unset;
  return option.fallback.empty() ? "" : "`" + option.fallback + "`";
}

std::string note_text(const Option& option) {
  std::string text = option.doc;
  if (!option.only_for.key.empty())
    text += fmt::format("; for {} = {}", option.only_for.key, quoted_list(option.only_for.values));
  std::vector<std::string> refused;
  for (const Refusal& refusal : option.refused) refused.push_back(refusal.value);
  if (!refused.empty()) text += "; not in this version: " + quoted_list(refused);
  return text;
}

std::string row(const Option& option) {
  const std::string range = describe(option.range), unit = option.unit;
  const std::string bounds = range.empty() || unit.empty() ? range + unit : range + ' ' + unit;
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", option.key, type_text(option), default_text(option), bounds,
                     note_text(option));
}

bool is_side(const Option& option) {
  return option.path.rfind("domain.boundary.", 0) == 0 && option.path.rfind("domain.boundary.x_lower", 0) != 0;
}

}  // namespace

std::string scene_reference() {
  std::vector<std::string> order;
  std::map<std::string, std::string> rows;
  std::string later;
  for (const Option& option : scene_options()) {
    const std::string table = parent(option.path);
    if (option.availability == Availability::later) {
      later += fmt::format("* `{}` in {}: {}\n", option.key, title(table), note_text(option));
      continue;
    }
    if (is_side(option) && table != "domain.boundary") continue;  // all sides are alike
    if (std::find(order.begin(), order.end(), table) == order.end()) order.push_back(table);
    rows[table] += row(option);
  }
  std::string text = introduction;
  for (const std::string& table : order) {
    const std::string alike = table.rfind("domain.boundary.x_lower", 0) == 0 ? " and the other sides" : "";
    text += fmt::format("\n## {}{}\n\n| key | value | default | range, unit | meaning |\n|---|---|---|---|---|\n{}",
                        title(table), alike, rows[table]);
  }
  return later.empty() ? text : text + "\n## Not in this version\n\n" + later;
}

}  // namespace seiche
