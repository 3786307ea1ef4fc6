#pragma once
// Copies of a solid: on a regular grid, or at random places that keep apart.
#include "base/solid_spec.h"
#include "scene/context.h"
#include "scene/section.h"
#include "scene/toml.h"

namespace seiche {

struct Scene;

std::vector<Key<SolidSpec>> copy_keys();

// Replaces each solid with an array or a scatter by its copies, named NAME-1, NAME-2, ... in the order x, y, z. Reports
// what cannot be copied, and copies that do not find room.
void expand_copies(SceneContext& context, const TomlNode& root, Scene& scene);

}  // namespace seiche
