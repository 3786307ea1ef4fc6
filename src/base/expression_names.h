#pragma once
// Names in the text of an expression, and messages about faulty ones.
#include <optional>
#include <string>
#include <vector>

namespace seiche {

struct NameInText {
  std::string name;
  std::size_t at = 0;   // position of its first character
  bool called = false;  // true if a parenthesis follows
};

// Variables, constants and functions in the order of the text. The e of an exponent is not a name.
std::vector<NameInText> names_in(const std::string& text);

// Message about the first name that is unknown or misplaced; nullopt if there is none. Misplaced: a function without
// argument, a variable called like a function, a number right before a name.
std::optional<std::string> fault_of_names(const std::string& text);

}  // namespace seiche
