#pragma once
// Waves in liquid of finite depth: motions of paddles that make them, and sides of the domain that they pass.
#include "base/domain_spec.h"
#include "base/solid_spec.h"
#include "base/water_waves.h"
#include "scene/context.h"
#include "scene/section.h"
#include "scene/toml.h"

namespace seiche {

struct Scene;

// Wave height over the stroke at the level of rest, H/S, of a paddle that is a piston or a flap hinged at the bottom;
// kh: wave number times depth. Dean and Dalrymple, Water Wave Mechanics (1991), equations 6.25 and 6.28.
double height_over_stroke(const std::string& paddle, double kh);

using PaddleTerm = WaveTerm;  // a sin(w t + phase) of a paddle's displacement at the level of rest

// Displacement that makes the waves, before its ramp.
std::vector<PaddleTerm> paddle_terms(const WavesSpec& waves, double gravity);

Section<WavesSpec> waves_section();
Section<SideWavesSpec> side_waves_section();

// Replaces the waves of all solids' motions by formulas. Reports what does not fit.
void expand_waves(SceneContext& context, const TomlNode& root, Scene& scene);

// Reports waves at sides of the domain that do not fit.
void check_side_waves(SceneContext& context, const TomlNode& root, const Scene& scene);

}  // namespace seiche
