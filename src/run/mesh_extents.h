#pragma once
// Meshes in the wrong unit, found by their bounding boxes before anything is computed from them.
#include <string>
#include <vector>

#include "base/scene.h"

namespace seiche {

// A mesh that is many times as wide as the domain was likely written in another unit. Throws Error(bad_input) naming
// the line where it is that of a rigid or elastic solid, which could not lie in the domain; else says so in a note.
std::vector<std::string> check_mesh_extents(const Scene& scene);

}  // namespace seiche
