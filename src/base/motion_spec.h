#pragma once
// Motions that a scene prescribes. Plain data in SI units.
#include <optional>
#include <string>

#include "base/formula.h"
#include "base/vec.h"

namespace seiche {

// Waves, and the wave maker's motion: that of a piston, or of a flap about a hinge at the bottom.
struct WavesSpec {
  std::string paddle = "piston";  // "flap"
  double depth = 0;               // m, of the liquid at rest
  double height = 0;              // m, from trough to crest; significant height of a spectrum
  double period = 0;              // s; of the peak of a spectrum
  std::string theory = "airy";    // "stokes": second order, for regular waves of a piston; "nonlinear": at sides
  std::string spectrum;           // "jonswap", "pierson_moskowitz"; empty: regular waves
  double peakedness = 3.3;        // gamma of jonswap
  int components = 24, seed = 1;  // of a spectrum
  std::optional<double> ramp;     // s, until the full height; unset: two periods
  Vec3 direction{1, 0, 0};        // of the waves
  std::optional<Vec3> hinge;      // a point of the flap's axis, m
};

// Displacement of a kinematic solid from its rest pose: first rotate about center, then translate.
struct MotionSpec {
  std::optional<WavesSpec> waves;  // as read; expand_waves() makes formulas of them
  VectorFormula translate{"0", "0", "0"};
  Vec3 axis{0, 0, 1}, center{0, 0, 0};
  Formula degrees = "0";
};

}  // namespace seiche
