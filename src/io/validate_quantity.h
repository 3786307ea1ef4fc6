#pragma once
// What a measure reads, by the names and the units of its scene.
#include <string>

#include "base/scene.h"
#include "io/validate_case.h"

namespace seiche {

// Throws Error(bad_input) where the scene has no such probe or solid, runs write no such column, or the data cannot be
// read; `where` begins the message, and a slip gets a suggestion.
void check_measure(const MeasureSpec& measure, const Scene& scene, const std::string& where);

// In words, such as "mean of a probe in a time, weighted with sin^2". A table's row for each kind of measure.
std::string what_is_measured(const MeasureSpec& measure);

// How its error comes about: "relative to the reference".
std::string error_in_words(const MeasureSpec& measure);

// Unit of the measure's figure, such as "m/s" or "J/m over unit"; empty for pure numbers. In 2D forces and what goes
// with mass are per metre.
std::string unit_of(const MeasureSpec& measure, const Scene& scene);

}  // namespace seiche
