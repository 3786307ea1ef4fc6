#pragma once
// What a measure gives, in words and units.
#include <string>

#include "base/scene.h"
#include "validate/measure/spec.h"

namespace seiche {

// In words, such as "mean of a probe in a time, weighted with sin^2". A table's row for each kind of measure.
std::string what_is_measured(const MeasureSpec& measure);

// How its error comes about: "relative to the reference".
std::string error_in_words(const MeasureSpec& measure);

// Unit of the measure's figure, such as "m/s" or "J/m over unit"; empty for pure numbers. In 2D forces and what goes
// with mass are per metre.
std::string unit_of(const MeasureSpec& measure, const Scene& scene);

}  // namespace seiche
