#pragma once
// The rows of the table of rheologies, one a file, and what they share.
#include "fluid/rheology/rheology.h"

namespace seiche::rheology {

RheologyModel bingham();
RheologyModel herschel_bulkley();
RheologyModel carreau();
RheologyModel power_law();

// tau_y (1 - exp(-r / m)) / r, Pa s: the stress tau_y of liquid that yields, over its shear rate (Papanastasiou 1987).
// tau_y / m at rest; from r = 7 m on the stress is tau_y to 0.1 %.
double yielding(double yield_stress, double rate, double m);

// K (r^2 + m^2)^((n - 1) / 2), Pa s: the power law, with K m^(n - 1) at rest.
double power(double consistency, double exponent, double rate, double m);

}  // namespace seiche::rheology
