#pragma once
// Detects meshes in the wrong unit by their bounding boxes, before any computation with them.
#include <string>
#include <vector>

namespace seiche {

struct Scene;

// A mesh many times as wide as the domain is probably in another unit. Throws Error(bad_input) naming the line for
// rigid and elastic solids, which must lie in the domain; returns a note for other uses.
std::vector<std::string> check_mesh_extents(const Scene& scene);

}  // namespace seiche
