// Terms that several rheologies share.
#include <cmath>

#include "fluid/rheology/rows.h"

namespace seiche::rheology {

double yielding(double yield_stress, double rate, double m) {
  const double x = rate / m;
  return yield_stress / m * (x > 0 ? -std::expm1(-x) / x : 1.0);
}

double power(double consistency, double exponent, double rate, double m) {
  return consistency * std::pow(std::hypot(rate, m), exponent - 1);
}

}  // namespace seiche::rheology
