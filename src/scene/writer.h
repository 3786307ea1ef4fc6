#pragma once
// Writes scenes as text.
#include <string>
#include <vector>

namespace seiche {

struct Scene;

// The scene as normalised TOML with all defaults written out; reads back to the same scene. File names are absolute
// paths.
std::string write_scene(const Scene& scene);

// Keys in which two scenes differ ("solid.0.radius"), in the order of the file. An entry that exists in one scene only
// is named once ("solid.2").
std::vector<std::string> changed_keys(const Scene& a, const Scene& b);

}  // namespace seiche
