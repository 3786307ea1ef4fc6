#pragma once
// The rows of the table of rheologies, one per file, and their common terms.
#include "fluid/rheology/rheology.h"

namespace seiche::rheology {

RheologyModel bingham();
RheologyModel herschel_bulkley();
RheologyModel carreau();
RheologyModel power_law();

// tau_y (1 - exp(-r / m)) / r, Pa s: the regularised yield stress over the shear rate (Papanastasiou 1987). It is tau_y
// / m at rest. For r >= 7 m the stress is tau_y to 0.1 %.
double yielding(double yield_stress, double rate, double m);

// K (r^2 + m^2)^((n - 1) / 2), Pa s: the regularised power law, K m^(n - 1) at rest.
double power(double consistency, double exponent, double rate, double m);

}  // namespace seiche::rheology
