#include "base/water_waves.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/steady_waves.h"

namespace seiche {
namespace {

constexpr double two_pi = 2 * M_PI;

// Variance density of a spectrum at r = f / f_p, up to a factor. Hasselmann et al., Measurements of wind-wave growth
// (JONSWAP, 1973); peakedness 1 is the spectrum of Pierson and Moskowitz (1964).
double spectral_shape(double r, double peakedness) {
  const double width = r <= 1 ? 0.07 : 0.09;
  return std::pow(r, -5) * std::exp(-1.25 * std::pow(r, -4)) *
         std::pow(peakedness, std::exp(-std::pow((r - 1) / width, 2) / 2));
}

// Equally likely in [0, 1), the same on all machines.
double draw(std::mt19937& random) {
  return double(random()) / 4294967296.0;
}

// cosh or sinh of k(z + h) over cosh kh, for z up to the crests; without overflow in deep liquid.
double profile(double k, double depth, double z, double sign) {
  const double y = z + depth;
  return (std::exp(k * z) + sign * std::exp(-k * (y + depth))) / (1 + std::exp(-2 * k * depth));
}

WaveMode linear_mode(double amplitude, double frequency, double phase, double gravity, double depth) {
  const double k = wave_number(frequency, gravity, depth);
  return {amplitude, amplitude * frequency / std::tanh(k * depth), k, frequency, phase};
}

// Volume that a linear wave carries along between its troughs and crests, <u(0) eta>, over the depth.
double current_against(const std::vector<WaveMode>& modes, double depth) {
  double carried = 0;
  for (const WaveMode& mode : modes) carried += 0.5 * mode.elevation * mode.speed;
  return -carried / depth;
}

// Dean and Dalrymple, Water Wave Mechanics (1991), section 11.3: second harmonic bound to the wave. Hyperbolic
// functions over exp(kh), so that deep liquid does not overflow.
WaveMode bound_harmonic(const WaveMode& first, double depth) {
  const double a = first.elevation, e = std::exp(-2 * first.number * depth), r = 1 - e;
  const double elevation = first.number * a * a / 2 * (1 + e) * (1 + 4 * e + e * e) / (r * r * r);
  const double speed = 6 * a * a * first.frequency * first.number * e * (1 + e * e) / (r * r * r * r);
  return {elevation, speed, 2 * first.number, 2 * first.frequency, 2 * first.phase};
}

WaveTrain irregular_train(const WavesSpec& waves, double gravity) {
  WaveTrain train;
  for (const WaveTerm& term : irregular_waves(waves))
    train.modes.push_back(linear_mode(term.amplitude, term.frequency, term.phase, gravity, waves.depth));
  return train;
}

WaveTrain regular_train(const WavesSpec& waves, double gravity) {
  WaveTrain train;
  train.modes = {linear_mode(waves.height / 2, two_pi / waves.period, M_PI / 2, gravity, waves.depth)};
  if (waves.theory != "stokes") return train;
  train.modes.push_back(bound_harmonic(train.modes[0], waves.depth));
  train.highest = train.modes[0].elevation + train.modes[1].elevation;
  return train;
}

WaveTrain nonlinear_train(const WavesSpec& waves, double gravity) {
  const SteadyWaves steady = steady_waves(waves.height, waves.period, waves.depth, gravity);
  WaveTrain train;
  for (std::size_t j = 1; j <= steady.speed.size(); ++j) {
    train.modes.push_back({steady.elevation[j - 1], steady.speed[j - 1], double(j) * steady.number,
                           double(j) * two_pi / waves.period, double(j) * M_PI / 2});
    train.highest += steady.elevation[j - 1];
  }
  train.current = steady.current;
  return train;
}

}  // namespace

// Newton's method from the limit of deep or shallow liquid, whichever has the larger k.
double wave_number(double w, double gravity, double depth) {
  const double deep = w * w / gravity;
  double k = std::max(deep, w / std::sqrt(gravity * depth));
  for (int n = 0; n < 50; ++n) {
    const double t = std::tanh(k * depth), f = k * t - deep, slope = t + k * depth * (1 - t * t);
    const double change = f / slope;
    k -= change;
    if (std::abs(change) < 1e-15 * k) break;
  }
  return k;
}

double steepest_wave(double kh) {
  return 0.142 * std::tanh(kh);
}

std::vector<WaveTerm> irregular_waves(const WavesSpec& waves) {
  constexpr double lowest = 0.5, highest = 2.5;  // f / f_p; they hold 98 % of the variance
  const double peakedness = waves.spectrum == "jonswap" ? waves.peakedness : 1;
  std::mt19937 random(std::uint32_t(waves.seed));
  std::vector<WaveTerm> terms;
  double variance = 0;
  for (int n = 0; n < waves.components; ++n) {
    const double r = lowest + (highest - lowest) * (n + draw(random)) / waves.components;
    const double density = spectral_shape(r, peakedness);
    terms.push_back({std::sqrt(2 * density), two_pi * r / waves.period, two_pi * draw(random)});
    variance += density;
  }
  for (WaveTerm& term : terms) term.amplitude *= waves.height / 4 / std::sqrt(variance);
  return terms;
}

double WaveTrain::elevation(double s, double t) const {
  double sum = 0;
  for (const WaveMode& m : modes) sum += m.elevation * std::cos(m.number * s - m.frequency * t + m.phase);
  return sum;
}

double WaveTrain::along(double s, double z, double t) const {
  z = std::clamp(z, -depth, highest);
  double sum = 0;
  for (const WaveMode& m : modes)
    sum += m.speed * profile(m.number, depth, z, 1) * std::cos(m.number * s - m.frequency * t + m.phase);
  return sum;
}

double WaveTrain::upward(double s, double z, double t) const {
  z = std::clamp(z, -depth, highest);
  double sum = 0;
  for (const WaveMode& m : modes)
    sum += m.speed * profile(m.number, depth, z, -1) * std::sin(m.number * s - m.frequency * t + m.phase);
  return sum;
}

WaveTrain wave_train(const WavesSpec& waves, double gravity) {
  const bool nonlinear = waves.theory == "nonlinear" && waves.height > 0;
  WaveTrain train = !waves.spectrum.empty() ? irregular_train(waves, gravity)
                    : nonlinear             ? nonlinear_train(waves, gravity)
                                            : regular_train(waves, gravity);
  train.depth = waves.depth;
  if (!nonlinear) train.current = current_against(train.modes, waves.depth);
  return train;
}

}  // namespace seiche
