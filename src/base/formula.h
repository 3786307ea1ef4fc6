#pragma once
// The text of formulas in a scene file.
#include <array>
#include <string>

namespace seiche {

// A number or a formula in x, y, z, t, as text for base/expression.h ("0.5", "6*y*(1-y)").
using Formula = std::string;
using VectorFormula = std::array<Formula, 3>;

}  // namespace seiche
