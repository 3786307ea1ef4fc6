#pragma once
// Checks a case before anything is run.
#include <string>

#include "validate/case/case.h"

namespace seiche {

struct Scene;

// Throws Error(bad_input) if the scene lacks the probe or solid or ends too early, if runs write no such column, if the
// data are unreadable or outside the domain, or if an error would be divided by zero. `where` starts the message;
// misspelt names get a suggestion.
void check_measure(const MeasureSpec& measure, const Scene& scene, const std::string& where);

// Throws Error(bad_input) if the plot's data are unreadable or its unit is zero.
void check_plot(const PlotSpec& plot, const std::string& where);

}  // namespace seiche
