#pragma once
// Checks of the expressions in a scene.
#include <optional>
#include <string>

#include "base/options.h"
#include "base/scene.h"

namespace seiche {

// The shortest decimal text that reads back to the same number, never "-0".
std::string number_text(double value);

// The number the whole text stands for, if it is one ("1e-3"); locale-independent.
std::optional<double> plain_number(const std::string& text);

// What is wrong with the text as a formula for this option (syntax, variables, a constant that is not finite or out of
// range), or nothing.
std::optional<std::string> formula_fault(const std::string& text, const Option& option);

}  // namespace seiche
