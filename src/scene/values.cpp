#include "scene/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/suggest.h"
#include "scene/formula.h"
#include "scene/units.h"

namespace seiche {
namespace {

using Kind = TomlNode::Kind;

bool is_number(const TomlNode& node) {
  return node.kind == Kind::number || node.kind == Kind::integer;
}

std::string unit_text(const Option& option) {
  return option.unit.empty() ? "" : " " + option.unit;
}

void report_type(SceneContext& c, const Place& p, const Option& option, const std::string& more = "") {
  const std::string unit = option.unit.empty() ? "" : " (" + option.unit + ")";
  const bool coded = p.node->kind == Kind::coded_integer;
  c.report(p, fmt::format("{} must be {}{}, not {}{}{}", p.path, type_name(option.type), unit, describe(*p.node),
                          coded ? "; write it in decimals" : "", more));
}

std::string range_text(const Option& option) {
  const std::string range = describe(option.range);
  if (!range.empty()) return range + unit_text(option);
  return fmt::format("a finite number below {} in magnitude", number_limit);
}

std::optional<double> in_range(SceneContext& c, const Place& p, const Option& option, double value) {
  if (!std::isfinite(value) || !contains(option.range, value)) {
    c.report(p, fmt::format("{} must be {}; it is {}", p.path, range_text(option), value));
    return std::nullopt;
  }
  return value == 0 ? 0.0 : value;
}

// A finite number within the option's range; -0 becomes 0. A text is an expression of parameters, or has a unit.
std::optional<double> checked_number(SceneContext& c, const Place& p, const Option& option) {
  if (p.node->kind == Kind::text && !p.node->text.empty()) {
    std::string fault;
    const auto value = number_of(p.node->text, option, c.parameters, fault);
    if (!value) {
      Option one = option;
      one.type = OptionType::number;
      report_type(c, p, one, "; it " + fault);
      return std::nullopt;
    }
    return in_range(c, p, option, *value);
  }
  if (!is_number(*p.node)) {
    Option one = option;
    one.type = OptionType::number;
    report_type(c, p, one);
    return std::nullopt;
  }
  return in_range(c, p, option, p.node->number);
}

std::optional<Formula> checked_formula(SceneContext& c, const Place& p, const Option& option) {
  if (is_number(*p.node)) {
    const auto number = checked_number(c, p, option);
    return number ? std::optional(number_text(*number)) : std::nullopt;
  }
  if (p.node->kind != Kind::text) {
    Option one = option;
    one.type = OptionType::formula;
    report_type(c, p, one);
    return std::nullopt;
  }
  const std::string text = with_parameters(p.node->text, c.parameters);
  const auto fault = formula_fault(text, option);
  if (!fault) {
    const auto number = plain_number(text);
    return number ? number_text(*number) : text;
  }
  if (split_unit(p.node->text)) {
    const auto number = checked_number(c, p, option);
    return number ? std::optional(number_text(*number)) : std::nullopt;
  }
  c.report(p, p.path + ": " + *fault);
  return std::nullopt;
}

// True if the node is an array with the right number of components; reports otherwise.
bool check_length(SceneContext& c, const Place& p, const Option& option) {
  if (p.node->kind != Kind::array) {
    report_type(c, p, option);
    return false;
  }
  const std::size_t size = p.node->items.size();
  const bool always_three = option.type == OptionType::axis || option.type == OptionType::spin;
  const std::size_t wanted = always_three ? 3 : std::size_t(c.dimension);
  if (size == wanted || (wanted == 0 && (size == 2 || size == 3))) return true;
  const std::string reason = option.type == OptionType::axis ? "" : fmt::format(" (dimension = {})", c.dimension);
  c.report(p, wanted == 0 ? fmt::format("{} must have 2 or 3 components, not {}", p.path, size)
                          : fmt::format("{} must have {} components{}, not {}", p.path, wanted, reason, size));
  return false;
}

Place item(const Place& p, std::size_t index) {
  return {&p.node->items[index], fmt::format("{}.{}", p.path, index)};
}

// Angular velocity in 2D: one number about z, given alone, in an array of one, or after two zeros as in 3D scenes.
void read_flat_spin(SceneContext& c, const Place& p, const Option& option, Vec3& out) {
  const bool array = p.node->kind == Kind::array;
  const std::size_t size = array ? p.node->items.size() : 1;
  std::vector<double> parts;
  if (!array && !is_number(*p.node) && !is_text(*p.node)) return report_type(c, p, option);
  for (std::size_t i = 0; i < size && (size == 1 || size == 3); ++i) {
    const auto number = checked_number(c, array ? item(p, i) : p, option);
    if (!number) return;
    parts.push_back(*number);
  }
  if (parts.empty() || (size == 3 && (parts[0] != 0 || parts[1] != 0))) {
    return c.report(p, fmt::format("{} must be one number ({}) in 2D: the rotation is about z", p.path, option.unit));
  }
  out = Vec3(0, 0, parts.back());
}

void check_plain_text(SceneContext& c, const Place& p) {
  constexpr std::size_t longest = 1000;
  const std::string& text = p.node->text;
  const auto control = [](char ch) { return static_cast<unsigned char>(ch) < 0x20 || ch == 0x7f; };
  if (text.size() > longest)
    c.report(p, fmt::format("{} must have at most {} characters, not {}", p.path, longest, text.size()));
  if (std::any_of(text.begin(), text.end(), control))
    c.report(p, p.path + " must be one line without control characters");
}

}  // namespace

bool is_text(const TomlNode& node) {
  return node.kind == Kind::text;
}

void read_value(SceneContext& c, const Place& p, const Option& option, double& out) {
  if (const auto value = checked_number(c, p, option)) out = *value;
}

void read_value(SceneContext& c, const Place& p, const Option& option, int& out) {
  if (p.node->kind != Kind::integer && p.node->kind != Kind::text) return report_type(c, p, option);
  const auto value = checked_number(c, p, option);
  if (value && *value != std::floor(*value))
    return c.report(p, fmt::format("{} must be a whole number; it is {}", p.path, *value));
  if (value) out = int(*value);
}

void read_value(SceneContext& c, const Place& p, const Option& option, bool& out) {
  if (p.node->kind != Kind::boolean) return report_type(c, p, option);
  out = p.node->boolean;
}

void read_value(SceneContext& c, const Place& p, const Option& option, Vec3& out) {
  if (option.type == OptionType::spin && c.dimension != 3) return read_flat_spin(c, p, option, out);
  if (!check_length(c, p, option)) return;
  Vec3 value = Vec3::Zero();
  bool good = true;
  for (std::size_t i = 0; i < p.node->items.size(); ++i) {
    const auto number = checked_number(c, item(p, i), option);
    good = good && number.has_value();
    value[Eigen::Index(i)] = number.value_or(0.0);
  }
  if (good) out = value;
}

void read_value(SceneContext& c, const Place& p, const Option& option, VectorFormula& out) {
  if (!check_length(c, p, option)) return;
  const std::string zero = number_text(0);
  VectorFormula value{zero, zero, zero};
  bool good = true;
  for (std::size_t i = 0; i < p.node->items.size(); ++i) {
    const auto formula = checked_formula(c, item(p, i), option);
    good = good && formula.has_value();
    value[i] = formula.value_or(zero);
  }
  if (good) out = value;
}

void read_value(SceneContext& c, const Place& p, const Option& option, std::string& out) {
  if (option.type == OptionType::formula) {
    if (const auto formula = checked_formula(c, p, option)) out = *formula;
    return;
  }
  if (!is_text(*p.node)) return report_type(c, p, option);
  const std::size_t before = c.problem_count();
  if (option.type == OptionType::choice) {
    check_choice(c, p, option, p.node->text);
  } else {
    check_plain_text(c, p);
  }
  if (c.problem_count() == before) out = p.node->text;
}

void read_value(SceneContext& c, const Place& p, const Option& option, std::array<double, 2>& out) {
  if (p.node->kind != Kind::array || p.node->items.size() != 2) return report_type(c, p, option);
  std::array<double, 2> value{};
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto number = checked_number(c, item(p, i), option);
    good = good && number.has_value();
    value[i] = number.value_or(0.0);
  }
  if (good) out = value;
}

void read_value(SceneContext& c, const Place& p, const Option& option, std::vector<std::string>& out) {
  if (p.node->kind != Kind::array) return report_type(c, p, option);
  const bool is_free = option.type == OptionType::pair || option.type == OptionType::names;
  if (option.type == OptionType::pair && p.node->items.size() != 2) return report_type(c, p, option);
  if (option.type == OptionType::names && p.node->items.empty()) return c.report(p, p.path + " must name at least one");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < p.node->items.size(); ++i) {
    const Place one = item(p, i);
    if (!is_text(*one.node)) {
      c.report(one, fmt::format("{} must be a name in quotes, not {}", one.path, describe(*one.node)));
    } else if (std::find(names.begin(), names.end(), one.node->text) != names.end()) {
      c.report(one, fmt::format("{} lists \"{}\" twice", p.path, one.node->text));
    } else if (is_free || check_choice(c, one, option, one.node->text)) {
      names.push_back(one.node->text);
    }
  }
  if (c.clean(p.path)) out = names;
}

bool check_choice(SceneContext& c, const Place& p, const Option& option, const std::string& value) {
  if (std::find(option.choices.begin(), option.choices.end(), value) != option.choices.end()) return true;
  const auto refused =
      std::find_if(option.refused.begin(), option.refused.end(), [&](auto& r) { return r.value == value; });
  if (refused != option.refused.end()) {
    c.report(p, fmt::format("{} = \"{}\": {}; this version has {}", p.path, value, refused->reason,
                            quoted_list(option.choices)));
    return false;
  }
  const auto near = suggest(value, option.choices);
  c.report(p, fmt::format("{} must be {}, not {}{}", p.path, quoted_list(option.choices), describe(*p.node),
                          near ? "; did you mean \"" + *near + "\"?" : ""));
  return false;
}

void read_value(SceneContext& c, const Place& p, const Option& option, std::vector<Vec3>& out) {
  if (p.node->kind != Kind::array) return report_type(c, p, option);
  Option one = option;
  one.type = OptionType::vector;
  std::vector<Vec3> points(p.node->items.size(), Vec3::Zero());
  const std::size_t before = c.problem_count();
  for (std::size_t n = 0; n < points.size(); ++n) read_value(c, item(p, n), one, points[n]);
  if (c.problem_count() == before) out = std::move(points);
}

}  // namespace seiche
