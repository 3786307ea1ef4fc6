#pragma once
// What a measure reads, by the names and the units of its scene.
#include <string>

#include "base/scene.h"
#include "io/validate_case.h"

namespace seiche {

// Throws Error(bad_input) where the scene has no such probe or solid, or runs write no such column; `where` begins the
// message, and a slip gets a suggestion.
void check_names(const MeasureSpec& measure, const Scene& scene, const std::string& where);

// Unit of the measure's figure, such as "m/s" or "J/m over unit"; empty for pure numbers. In 2D forces and what goes
// with mass are per metre.
std::string unit_of(const MeasureSpec& measure, const Scene& scene);

}  // namespace seiche
