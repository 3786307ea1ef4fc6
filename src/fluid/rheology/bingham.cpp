// Bingham 1922: tau = tau_y + mu r in yielded liquid.
#include <array>

#include "fluid/rheology/rows.h"

namespace seiche::rheology {

RheologyModel bingham() {
  static constexpr std::array<std::string_view, 3> keys{"viscosity", "yield_stress", "regularisation"};
  return {"bingham", keys, [](const RheologySpec& s, double rate) {
            return s.viscosity + yielding(s.yield_stress, rate, s.regularisation.value());
          }};
}

}  // namespace seiche::rheology
