#pragma once
// Robots of a scene as rigid solids and joints.
#include "scene/context.h"
#include "scene/toml.h"

namespace seiche {

struct Scene;

// Replaces [[robot]] tables by the solids and joints of their files (URDF), named "robot/link" and "robot/joint".
// Reports files that cannot be read or that hold what a scene cannot.
void expand_robots(SceneContext& context, const TomlNode& root, Scene& scene);

}  // namespace seiche
