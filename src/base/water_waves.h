#pragma once
// Theory of progressive waves on liquid of finite depth: linear, Stokes's second order, steady nonlinear, irregular.
#include <vector>

#include "base/motion_spec.h"

namespace seiche {

// k (1/m) of w^2 = g k tanh(k h): linear waves of angular frequency w (1/s) on depth h (m).
double wave_number(double w, double gravity, double depth);

// The steepest height over length of waves before they break, Miche (1944); kh: wave number times depth.
double steepest_wave(double kh);

// One wave a cos(w t + phase) of a sum: m, 1/s, rad.
struct WaveTerm {
  double amplitude, frequency, phase;
};

// Terms of a spectrum, with sum a^2 / 2 = (H_s / 4)^2: bands of equal width from 0.5 to 2.5 of the peak's frequency,
// one term at a random place of each, so that the sum does not repeat.
std::vector<WaveTerm> irregular_waves(const WavesSpec& waves);

// With theta = k s - w t + phase, s (m) along the waves and z (m) above the level of rest on depth h:
//   eta = a cos theta,  u = U cosh k(z + h)/cosh kh cos theta,  w = U sinh k(z + h)/cosh kh sin theta.
struct WaveMode {
  double elevation = 0;  // a, m
  double speed = 0;      // U, m/s
  double number = 0;     // k, 1/m
  double frequency = 0;  // w, 1/s
  double phase = 0;
};

// Waves as a sum of modes and of a uniform current, which returns what they carry along: no net volume in a period.
struct WaveTrain {
  std::vector<WaveMode> modes;
  double current = 0;  // m/s, against the waves
  double depth = 0;    // m
  double highest = 0;  // z up to which speeds follow the modes, m; above they are constant

  double elevation(double s, double t) const;
  double along(double s, double z, double t) const;   // u without the current, m/s
  double upward(double s, double z, double t) const;  // w, m/s
};

// The waves that rise through the level of rest at s = 0, t = 0, before their ramp. Throws Error(bad_input) if there
// are no steady nonlinear waves of this height.
WaveTrain wave_train(const WavesSpec& waves, double gravity);

}  // namespace seiche
