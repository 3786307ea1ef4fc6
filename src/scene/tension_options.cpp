// Keys of surface tension in [liquid] and [[solid]].
#include "base/fluid_spec.h"
#include "scene/options.h"

namespace seiche {

Key<LiquidSpec> surface_tension_key() {
  return value_key<LiquidSpec>({.key = "surface_tension",
                                .unit = "N/m",
                                .range = between(0, number_limit),
                                .doc = "surface tension sigma; that of clean water in air is 0.072"},
                               &LiquidSpec::surface_tension);
}

Key<LiquidSpec> tension_scheme_key() {
  return choice_key<LiquidSpec, TensionScheme LiquidSpec::*, TensionScheme>(
      {.key = "surface_tension_scheme",
       .doc = "\"explicit\": steps are held to sqrt(density cell_size^3 / (4 pi surface_tension)); \"semi_implicit\": "
              "they are not, and capillary waves that a step is too long for go more slowly"},
      &LiquidSpec::tension_scheme,
      {{"explicit", TensionScheme::explicit_steps}, {"semi_implicit", TensionScheme::semi_implicit}});
}

// Lower bound: in wedges of liquid or air below 20 degrees the surface continues behind the wall further than the
// ranks' overlap of cells.
Option contact_angle_option(const std::string& where) {
  return {.key = "contact_angle",
          .unit = "degrees",
          .range = between(20, 160),
          .doc = "angle within the liquid " + where + ", with surface_tension; below 90 it wets"};
}

}  // namespace seiche
