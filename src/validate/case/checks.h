#pragma once
// What is wrong with a case is said before anything is run.
#include <string>

#include "base/scene.h"
#include "validate/case/case.h"

namespace seiche {

// Throws Error(bad_input) where the scene has no such probe or solid or ends too early, runs write no such column, the
// data cannot be read or lie outside of the domain, or an error would be over zero; `where` begins the message, and a
// slip gets a suggestion.
void check_measure(const MeasureSpec& measure, const Scene& scene, const std::string& where);

// Throws Error(bad_input) where the plot's data cannot be read or its unit is zero.
void check_plot(const PlotSpec& plot, const std::string& where);

}  // namespace seiche
