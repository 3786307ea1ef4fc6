#pragma once
// Checks formulas in a scene.
#include <optional>
#include <string>

#include "base/formula.h"
#include "base/options.h"

namespace seiche {

// Shortest decimal text that reads back to the same number; never "-0".
std::string number_text(double value);

// Number represented by the whole text ("1e-3"), if it is one; independent of the locale.
std::optional<double> plain_number(const std::string& text);

// The first signal that a formula uses.
std::optional<std::string> signal_in(const std::string& text);

// Fault of the text as a formula for this option (syntax, variables, a constant that is not finite or out of range), or
// empty.
std::optional<std::string> formula_fault(const std::string& text, const Option& option);

}  // namespace seiche
