#include "base/options.h"

#include <fmt/format.h>

namespace seiche {

Range any_number() {
  return {};
}
Range positive(double high) {
  return {0, high, Bound::excluded, Bound::included};
}
Range between(double low, double high) {
  return {low, high, Bound::included, Bound::included};
}

// False for NaN.
bool contains(const Range& range, double value) {
  const bool above = range.low_bound == Bound::included ? value >= range.low : value > range.low;
  return above && (range.high_bound == Bound::included ? value <= range.high : value < range.high);
}

std::string describe(const Range& range) {
  std::string text;
  if (range.low > -number_limit)
    text = fmt::format("{} {}", range.low_bound == Bound::included ? ">=" : ">", range.low);
  if (range.high < number_limit) {
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ", range.high_bound == Bound::included ? "<=" : "<",
                        range.high);
  }
  return text;
}

std::string type_name(OptionType type) {
  switch (type) {
    case OptionType::number:
      return "a number";
    case OptionType::integer:
      return "a whole number";
    case OptionType::boolean:
      return "true or false";
    case OptionType::text:
      return "a text in quotes";
    case OptionType::choice:
      return "a name in quotes";
    case OptionType::choice_list:
    case OptionType::names:
      return "an array of names in quotes";
    case OptionType::pair:
      return "an array of two names in quotes";
    case OptionType::interval:
      return "an array of two numbers";
    case OptionType::vector:
      return "an array of numbers";
    case OptionType::axis:
      return "an array of three numbers";
    case OptionType::quaternion:
      return "an array of four numbers";
    case OptionType::spin:
      return "an array of three numbers (2D: a number)";
    case OptionType::formula:
      return "a number or an expression in quotes";
    case OptionType::formula_vector:
      return "an array of numbers or expressions in quotes";
    case OptionType::file:
      return "a path in quotes";
    case OptionType::table:
      return "a table";
    case OptionType::table_list:
      return "an array of tables";
  }
  return "";
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += '"' + names[i] + '"';
  }
  return text;
}

}  // namespace seiche
