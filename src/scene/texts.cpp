// Writes values of a scene as TOML text.
#include <fmt/format.h>

#include "scene/formula.h"
#include "scene/values.h"

namespace seiche {
namespace {

template <class Items, class Function>
std::string array_text(const Items& items, std::size_t count, Function text_of) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) text += (i ? ", " : "") + text_of(items[i]);
  return text + "]";
}

// Writes constant formulas as plain numbers.
std::string formula_text(const Formula& formula) {
  const auto number = plain_number(formula);
  return number ? number_text(*number) : quote_toml(formula);
}

}  // namespace

std::string quote_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20 || code == 0x7f) {
      quoted += fmt::format("\\u{:04X}", code);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string to_toml(double value, const Option&, int) {
  return number_text(value);
}
std::string to_toml(int value, const Option&, int) {
  return fmt::format("{}", value);
}
std::string to_toml(bool value, const Option&, int) {
  return value ? "true" : "false";
}

std::string to_toml(const Vec3& value, const Option& option, int dimension) {
  if (option.type == OptionType::spin && dimension == 2) return number_text(value[2]);
  const std::size_t count = option.type == OptionType::axis ? 3 : std::size_t(dimension);
  return array_text(value, count, [](double v) { return number_text(v); });
}

std::string to_toml(const VectorFormula& value, const Option&, int dimension) {
  return array_text(value, std::size_t(dimension), formula_text);
}

std::string to_toml(const std::string& value, const Option& option, int) {
  return option.type == OptionType::formula ? formula_text(value) : quote_toml(value);
}

std::string to_toml(const std::vector<std::string>& value, const Option& option, int) {
  if (option.type == OptionType::names && value.empty()) return {};
  return array_text(value, value.size(), quote_toml);
}

std::string to_toml(const std::vector<Vec3>& value, const Option& option, int dimension) {
  if (value.empty()) return {};
  return array_text(value, value.size(), [&](const Vec3& x) { return to_toml(x, option, dimension); });
}

std::string to_toml(const std::array<double, 2>& value, const Option&, int) {
  return array_text(value, 2, [](double v) { return number_text(v); });
}

std::string to_toml(const std::filesystem::path& value, const Option&, int) {
  return quote_toml(value.string());
}

}  // namespace seiche
