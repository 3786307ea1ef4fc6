#pragma once
// Wave makers: motions of paddles that make regular and irregular waves in liquid of finite depth.
#include "base/solid_spec.h"
#include "scene/context.h"
#include "scene/section.h"
#include "scene/toml.h"

namespace seiche {

struct Scene;

// k (1/m) of w^2 = g k tanh(k h): linear waves of angular frequency w (1/s) on depth h (m).
double wave_number(double w, double gravity, double depth);

// Wave height over the stroke at the level of rest, H/S, of a paddle that is a piston or a flap hinged at the bottom;
// kh: wave number times depth. Dean and Dalrymple, Water Wave Mechanics (1991), equations 6.25 and 6.28.
double height_over_stroke(const std::string& paddle, double kh);

// One term a sin(w t + phase) of a paddle's displacement at the level of rest: m, 1/s, rad.
struct PaddleTerm {
  double amplitude, frequency, phase;
};

// Displacement that makes the waves, before its ramp.
std::vector<PaddleTerm> paddle_terms(const WavesSpec& waves, double gravity);

Section<WavesSpec> waves_section();

// Replaces the waves of all solids' motions by formulas. Reports what does not fit.
void expand_waves(SceneContext& context, const TomlNode& root, Scene& scene);

}  // namespace seiche
