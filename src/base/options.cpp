#include "base/options.h"

#include <fmt/format.h>

#include <map>

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
  using T = OptionType;
  static const std::map<T, std::string> names{{T::number, "a number"},
                                              {T::integer, "a whole number"},
                                              {T::boolean, "true or false"},
                                              {T::text, "a text in quotes"},
                                              {T::choice, "a name in quotes"},
                                              {T::choice_list, "an array of names in quotes"},
                                              {T::names, "an array of names in quotes"},
                                              {T::pair, "an array of two names in quotes"},
                                              {T::interval, "an array of two numbers"},
                                              {T::vector, "an array of numbers"},
                                              {T::points, "an array of points, each an array of numbers"},
                                              {T::axis, "an array of three numbers"},
                                              {T::quaternion, "an array of four numbers"},
                                              {T::spin, "an array of three numbers (2D: a number)"},
                                              {T::formula, "a number or an expression in quotes"},
                                              {T::formula_vector, "an array of numbers or expressions in quotes"},
                                              {T::file, "a path in quotes"},
                                              {T::table, "a table"},
                                              {T::table_list, "an array of tables"}};
  return names.at(type);
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
