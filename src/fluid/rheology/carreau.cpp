// Carreau 1972: mu = mu_inf + (mu_0 - mu_inf) (1 + (time r)^2)^((n - 1) / 2). Bounded without regularisation.
#include <array>
#include <cmath>

#include "fluid/rheology/rows.h"

namespace seiche::rheology {

RheologyModel carreau() {
  static constexpr std::array<std::string_view, 4> keys{"viscosity_zero", "viscosity_infinity", "time", "exponent"};
  return {"carreau", keys, [](const RheologySpec& s, double rate) {
            const double share = std::pow(std::hypot(1.0, s.time * rate), s.exponent - 1);
            return s.viscosity_infinity + (s.viscosity_zero - s.viscosity_infinity) * share;
          }};
}

}  // namespace seiche::rheology
