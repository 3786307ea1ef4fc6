// Herschel, Bulkley 1926: tau = tau_y + K r^n in yielded liquid.
#include <array>

#include "fluid/rheology/rows.h"

namespace seiche::rheology {

RheologyModel herschel_bulkley() {
  static constexpr std::array<std::string_view, 4> keys{"consistency", "exponent", "yield_stress", "regularisation"};
  return {"herschel_bulkley", keys, [](const RheologySpec& s, double rate) {
            const double m = s.regularisation.value();
            return power(s.consistency, s.exponent, rate, m) + yielding(s.yield_stress, rate, m);
          }};
}

}  // namespace seiche::rheology
