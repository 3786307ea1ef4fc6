#pragma once
// Probes of a scene together with its solids, and probes at several points.
#include "scene/context.h"

namespace seiche {

struct Scene;

// Part of check_scene(): points and boxes lie in the domain, solids that probes name are there. Reports those that are
// not. The scene's domain must be valid.
void check_probes(SceneContext& context, const TomlNode& root, const Scene& scene);

// Puts one probe for each point in the place of a probe at several points: NAME-1, NAME-2, ... along a line, NAME-i-j
// in a parallelogram. Reports names that are taken.
void expand_probes(SceneContext& context, const TomlNode& root, Scene& scene);

}  // namespace seiche
