#pragma once
// Steady nonlinear waves on liquid of finite depth by Fourier's method: Rienecker and Fenton, A Fourier approximation
// method for steady water waves, J. Fluid Mech. 104 (1981).
#include <vector>

namespace seiche {

// eta = sum_j a_j cos j(kx - wt),  u = current + sum_j U_j cosh jk(z + h)/cosh jkh cos j(kx - wt).
struct SteadyWaves {
  double number = 0;                     // k, 1/m
  double current = 0;                    // m/s, so that no volume passes in a period
  std::vector<double> elevation, speed;  // a_j, m; U_j, m/s; j = 1, 2, ...
};

// Waves of this height (m) from trough to crest and period (s). Throws Error(bad_input) if none are found.
SteadyWaves steady_waves(double height, double period, double depth, double gravity);

}  // namespace seiche
