// Ostwald, de Waele: tau = K r^n.
#include <array>

#include "fluid/rheology/rows.h"

namespace seiche::rheology {

RheologyModel power_law() {
  static constexpr std::array<std::string_view, 3> keys{"consistency", "exponent", "regularisation"};
  return {"power_law", keys, [](const RheologySpec& s, double rate) {
            return power(s.consistency, s.exponent, rate, s.regularisation.value());
          }};
}

}  // namespace seiche::rheology
