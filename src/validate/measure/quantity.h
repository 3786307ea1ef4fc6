#pragma once
// Description and unit of a measure.
#include <string>

#include "validate/measure/spec.h"

namespace seiche {

struct Scene;

// Description, such as "mean of a probe in a time, weighted with sin^2". From a table with a row for each kind.
std::string what_is_measured(const MeasureSpec& measure);

// Definition of its error, such as "relative to the reference".
std::string error_in_words(const MeasureSpec& measure);

// Unit of the measure's figure, such as "m/s" or "J/m over unit"; empty for dimensionless figures. In 2D, forces and
// quantities proportional to mass are per metre.
std::string unit_of(const MeasureSpec& measure, const Scene& scene);

}  // namespace seiche
