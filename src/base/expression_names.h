#pragma once
// Names inside the text of an expression, and what is wrong with them.
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct NameInText {
  std::string name;
  std::size_t at = 0;   // place of its first character
  bool called = false;  // a parenthesis follows
};

// Variables, constants and functions in the order of the text; exponents of numbers are none.
std::vector<NameInText> names_in(const std::string& text);

// Message on the first name that the language lacks or that stands in the wrong place, or nothing.
std::optional<std::string> fault_of_names(const std::string& text);

}  // namespace seiche
