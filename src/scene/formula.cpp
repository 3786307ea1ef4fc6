#include "scene/formula.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/expression.h"
#include "base/expression_names.h"
#include "base/signals.h"

namespace seiche {
namespace {

// First of x, y, z, t in the text that the option does not allow, or empty.
std::optional<std::string> strange_variable(const std::string& text, const std::string& allowed) {
  for (const NameInText& found : names_in(text)) {
    const bool coordinate = found.name.size() == 1 && std::string("xyzt").find(found.name) != std::string::npos;
    if (coordinate && allowed.find(found.name) == std::string::npos) return found.name;
  }
  return std::nullopt;
}

bool assigns(const std::string& text) {
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    const char before = at > 0 ? text[at - 1] : ' ', after = at + 1 < text.size() ? text[at + 1] : ' ';
    if (std::string("=<>!").find(before) == std::string::npos && after != '=') return true;
  }
  return false;
}

bool has_list(const std::string& text) {
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ',' && depth <= 0) return true;
  }
  return false;
}

std::optional<std::string> fault_of_value(const std::string& text, const Option& option) {
  const Expression expression(text);
  if (!expression.is_constant()) return std::nullopt;
  const double value = expression(Vec3(0, 0, 0), 0);
  if (contains(option.range, value)) return std::nullopt;
  return fmt::format("the expression '{}' is {}; it must be a finite number {}", text, value, describe(option.range));
}

}  // namespace

std::string number_text(double value) {
  std::string text = fmt::format("{}", value == 0 ? 0.0 : value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

std::optional<double> plain_number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::string> signal_in(const std::string& text) {
  for (const NameInText& found : names_in(text))
    if (is_signal(found.name)) return found.name;
  return std::nullopt;
}

std::optional<std::string> formula_fault(const std::string& text, const Option& option) {
  constexpr std::size_t longest = 4096;
  if (text.size() > longest)
    return fmt::format("an expression has at most {} characters, this one {}", longest, text.size());
  if (assigns(text)) return "the expression '" + text + "' assigns with '='; compare with '=='";
  if (has_list(text)) return "the expression '" + text + "' is a list; one value is wanted";
  if (const auto word = strange_variable(text, option.variables)) {
    std::string names;
    for (const char c : option.variables) names += (names.empty() ? "" : ", ") + std::string(1, c);
    return fmt::format("the expression '{}' uses {}; it may depend on {} alone", text, *word, names);
  }
  const auto signal = signal_in(text);
  if (signal && option.variables.find('t') == std::string::npos)
    return fmt::format("the expression '{}' uses the signal {}; only formulas in t may", text, *signal);
  try {
    return fault_of_value(text, option);
  } catch (const Error& e) {
    return e.what();
  }
}

}  // namespace seiche
