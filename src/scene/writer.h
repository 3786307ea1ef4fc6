#pragma once
// Scenes as text.
#include <string>
#include <vector>

#include "base/scene.h"

namespace seiche {

// The scene as normalised TOML with every default written out; reads back to the same scene. Files are named by their
// absolute paths.
std::string write_scene(const Scene& scene);

// The keys in which two scenes differ ("solid.0.radius"), in the order of the file; an entry that only one scene has is
// named once ("solid.2").
std::vector<std::string> changed_keys(const Scene& a, const Scene& b);

}  // namespace seiche
